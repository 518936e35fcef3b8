"""What changes between the stages of a run in LAMMPS.

Walls move by variables, and gravity follows variables where it changes: both go on without a setup (`run ... pre no`).
Other values of pairs need a setup, at which `fix wall/gran` takes the polynomial of tsuji of its own result. Walls with
that dashpot are therefore made anew at every setup, as are those whose values change, and drop their springs.
"""

from __future__ import annotations

from dataclasses import dataclass

from cross_check.adapters import capability
from cross_check.adapters.interface import Row
from cross_check.adapters.lammps import laws
from cross_check.adapters.lammps.walls import Wall, kinds, walls_of, ways
from cross_check.adapters.render import number, numbers, word
from cross_check.adapters.stages import Segment, changed_rows, moves, segments
from cross_check.scene import Scene


@dataclass(frozen=True)
class Stage:
    """One `run`: number of steps, what driven particles follow, pairs, walls and gravity that hold, what precedes it.

    `setup` is false where forces go on as they are. `rows` are those that the start does not have.
    """

    steps: int
    moves: object
    pairs: list[dict[str, str]]
    walls: list[Wall]
    gravity: list[str]
    commands: list[str]
    setup: bool
    rows: list[Row]


@dataclass(frozen=True)
class _Part:
    pairs: list[dict[str, str]]
    walls: list[Wall]
    gravity: list[str]
    rows: list[Row]


def stages(scene: Scene) -> list[Stage]:
    """Every `run` of the deck."""
    parts = segments(scene)
    varies = len({part.scene.gravity for part in parts}) > 1
    found: list[Stage] = []
    before: _Part | None = None
    for segment, displacements, leg in zip(parts, ways(scene), moves(scene), strict=True):
        part = _part(segment.scene, walls_of(segment.scene, displacements), varies)
        commands, rows, setup = ([], [], False) if before is None else _change(segment, before, part)
        found.append(Stage(segment.steps, leg, part.pairs, part.walls, part.gravity, commands, setup, rows))
        before = part
    return found


def _part(scene: Scene, walls: list[Wall], varies: bool) -> _Part:
    magnitude, direction = capability.gravity(scene)
    weight = f"{number(magnitude)} vector {numbers(direction)}"
    rows = [Row("gravity", numbers(scene.gravity), "fix gravity", weight, "m/s2", "magnitude and direction")]
    rows += [row for pair in capability.touching(scene) for row in laws.pair_rows(scene, pair)]
    rows += [row for wall in walls for row in wall.rows]
    return _Part(_pair_lines(scene), walls, _gravity(scene, varies), rows)


def _gravity(scene: Scene, varies: bool) -> list[str]:
    """Commands that set gravity; the last one stands once only."""
    magnitude, direction = capability.gravity(scene)
    if not varies:
        return [f"fix gravity all gravity {number(magnitude)} vector {numbers(direction)}"]
    values = zip(("", "_x", "_y", "_z"), (magnitude, *direction), strict=True)
    variables = [f"variable gravity{name} equal {number(value)}" for name, value in values]
    return [*variables, "fix gravity all gravity v_gravity vector v_gravity_x v_gravity_y v_gravity_z"]


def _pair_lines(scene: Scene) -> list[dict[str, str]]:
    """One `pair_coeff` per pair of atom types; types that never touch get a contact without stiffness."""
    own = kinds(scene)
    stated = {pair.between: pair for pair in capability.touching(scene)}
    lines: list[dict[str, str]] = []
    for i, first in enumerate(own):
        for j, second in enumerate(own[i:], start=i):
            pair = stated.get((first, second))
            names = f"{word(scene.materials[first].name)} with {word(scene.materials[second].name)}"
            if pair is None:
                words = f"{i + 1} {j + 1} {laws.no_contact(scene)}"
                lines.append({"comment": f"{names}: never touch here", "words": words})
            else:
                words = f"{i + 1} {j + 1} {laws.coefficients(scene, pair)}"
                lines.append({"comment": names, "words": words})
    return lines


def _change(segment: Segment, before: _Part, part: _Part) -> tuple[list[str], list[Row], bool]:
    """Commands and rows of what a part has other than the part before, and whether they need a setup."""
    old = {line for wall in before.walls for line in wall.commands}
    new = [line for wall in part.walls for line in wall.commands if line not in old]
    setup = part.pairs != before.pairs or any(line.startswith("fix ") for line in new)
    rows = changed_rows(segment, part.rows, before.rows)
    commands = [f"pair_coeff      {pair['words']}" for pair in part.pairs if pair not in before.pairs]
    commands += [line for line in part.gravity if line not in before.gravity]
    if setup:
        for wall in part.walls:
            again = [line for line in wall.commands if line.startswith("fix ") and (line in new or " tsuji" in line)]
            new += [line for line in again if line not in new]
            key = f"stages.{segment.name}.bodies.{wall.body.name}"
            rows += [Row(key, "made anew", f"fix {wall.fix}", "", "-", "drops the springs of its contacts") for _ in again]
    note = "forces of the step evaluated anew, springs as they are" if setup else "goes on without a setup"
    head = [f"# stage {word(segment.name)}: {note}"] if segment.name else []
    return head + commands + new, rows, setup
