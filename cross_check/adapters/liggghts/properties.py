"""Global properties of pairs in a LIGGGHTS deck."""

from __future__ import annotations

from collections.abc import Callable

from cross_check.adapters import capability
from cross_check.adapters.interface import Row
from cross_check.adapters.render import number
from cross_check.scene import Pair, Scene

Values = dict[tuple[int, int], str]


def matrix(scene: Scene, fix: str, key: str, values: Values, never: str) -> list[str]:
    """The command of a symmetric property over atom types; pairs that never touch get `never`."""
    kinds = range(len(scene.materials))
    rows = [" ".join(values.get((min(i, j), max(i, j)), never) for j in kinds) for i in kinds]
    head = f"fix {fix} all property/global {key} peratomtypepair {len(rows)} &"
    return [head, *(f"    {row} &" for row in rows[:-1]), f"    {rows[-1]}"]


def pair_rows(
    scene: Scene, pairs: list[Pair], name: str, code_key: str, value: Callable[[Pair], float], unit: str = "-"
) -> tuple[Values, list[Row]]:
    """A value of every pair as stated: the entries of its matrix and the rows of the translation."""
    values: Values = {}
    rows: list[Row] = []
    for pair in pairs:
        text = values[pair.between] = number(value(pair))
        i, j = (index + 1 for index in pair.between)
        rows.append(
            Row(f"{capability.pair_key(scene, pair)}.{name}", text, f"{code_key} {i} {j}", text, unit, "as stated")
        )
    return values, rows
