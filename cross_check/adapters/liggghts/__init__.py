"""The adapter of LIGGGHTS."""

from __future__ import annotations

from cross_check.adapters.interface import Adapter
from cross_check.adapters.liggghts import mirror, run, translate

adapter = Adapter(
    name="liggghts",
    proved_versions=("3.8.0",),
    installed=run.installed,
    deck=translate.deck,
    mirror=mirror.mirror,
    run=run.run,
)
