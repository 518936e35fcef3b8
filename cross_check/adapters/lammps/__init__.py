"""The adapter of LAMMPS."""

from __future__ import annotations

from cross_check.adapters.interface import Adapter
from cross_check.adapters.lammps import mirror, run, translate

adapter = Adapter(
    name="lammps",
    proved_versions=("29 Sep 2021 - Update 2",),
    installed=run.installed,
    deck=translate.deck,
    mirror=mirror.mirror,
    run=run.run,
)
