"""Rolling and twisting resistance in the words of LAMMPS."""

from __future__ import annotations

from cross_check.adapters.interface import Row
from cross_check.scene import Pair, Scene


def words(scene: Scene, pair: Pair) -> str:
    """The words of the moment law, none if particles turn freely."""
    return ""


def rows(scene: Scene, pair: Pair) -> list[Row]:
    """The translation of the moment law."""
    return []


def no_contact(scene: Scene) -> str:
    """The same law without stiffness, for atom types that never touch."""
    return ""
