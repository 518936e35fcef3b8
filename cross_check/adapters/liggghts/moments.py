"""Rolling and twisting resistance in the words of LIGGGHTS."""

from __future__ import annotations

from dataclasses import dataclass

from cross_check.adapters.interface import Row
from cross_check.scene import Pair, Scene


@dataclass(frozen=True)
class Words:
    """Words after `model`, settings, comment, property commands and translation of a moment law."""

    model: str
    settings: str
    comment: str
    properties: list[str]
    rows: list[Row]


def words(scene: Scene, pairs: list[Pair]) -> Words:
    """The moment law of `scene`."""
    return Words("", "", "", [], [])
