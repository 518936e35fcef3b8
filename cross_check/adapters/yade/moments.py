"""Rolling and twisting resistance in the words of YADE (MindlinPhys)."""

from __future__ import annotations

from dataclasses import dataclass

from cross_check.adapters.interface import Row
from cross_check.scene import Pair, Scene


@dataclass(frozen=True)
class Words:
    """Words of the interaction physics and of the law functor, and the translation."""

    physics: str
    law: list[str]
    rows: list[Row]


def words(scene: Scene, pairs: list[Pair]) -> Words:
    """The moment law of `scene`."""
    return Words("", [], [])
