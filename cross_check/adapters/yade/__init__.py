"""The adapter of YADE."""

from __future__ import annotations

from cross_check.adapters.interface import Adapter
from cross_check.adapters.yade import mirror, run, translate

adapter = Adapter(
    name="yade",
    proved_versions=("2023.02a",),
    installed=run.installed,
    deck=translate.deck,
    mirror=mirror.mirror,
    run=run.run,
)
