"""Adapters of the external codes: each translates a scene, runs its code and answers with a run record."""

from __future__ import annotations

from cross_check.adapters import lammps, liggghts, yade
from cross_check.adapters.interface import Adapter

ADAPTERS: dict[str, Adapter] = {
    "liggghts": liggghts.adapter,
    "yade": yade.adapter,
    "lammps": lammps.adapter,
}
