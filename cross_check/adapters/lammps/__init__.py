"""The adapter of LAMMPS."""

from __future__ import annotations

from pathlib import Path

from cross_check.adapters.interface import Deck, RunFailed
from cross_check.adapters.lammps import mirror as mirroring
from cross_check.adapters.lammps import run as running
from cross_check.adapters.lammps import translate
from cross_check.record import Code, RunRecord
from cross_check.scene import Scene


class Lammps:
    """LAMMPS, as the harness sees it."""

    name = "lammps"
    proved_versions: tuple[str, ...] = ("29 Sep 2021 - Update 2",)

    def installed(self) -> Code | None:
        """The installed program with its version and package, or None."""
        return running.installed()

    def deck(self, scene: Scene) -> Deck:
        """Translates and renders. Raises NotComparable with the reason."""
        return translate.deck(scene)

    def mirror(self, scene: Scene) -> Scene:
        """The same scene with the engine options that reproduce what this code computes."""
        return mirroring.mirror(scene)

    def run(self, decks: list[Deck], folder: Path, time_limit: float) -> list[RunRecord | RunFailed]:
        """Runs the decks headless below `folder`; one result per deck, in order; `time_limit` is seconds per deck."""
        return running.run(decks, folder, time_limit)


adapter = Lammps()
