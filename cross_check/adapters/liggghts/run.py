"""Runs LIGGGHTS decks, one process each, and reads what they wrote."""

from __future__ import annotations

from pathlib import Path

from cross_check.adapters import installed as programs
from cross_check.adapters.contacts import Rows, pair_rows
from cross_check.adapters.dump import CONTACTS, HISTORY, PARTICLES, read_entries, read_run
from cross_check.adapters.interface import Deck, RunFailed
from cross_check.adapters.liggghts.translate import CONTACT_COLUMNS, wall_columns
from cross_check.adapters.runner import missing, record_of, run_each, run_program
from cross_check.record import Code, RunRecord
from cross_check.scene import Scene

VARIABLE = "CROSSGRAIN_LIGGGHTS"
PROGRAM = "liggghts"


def installed() -> Code | None:
    """The installed LIGGGHTS, or None."""
    return programs.installed("liggghts", VARIABLE, PROGRAM, "-h", r"LIGGGHTS-\w+ ([0-9][^\s,)]*)")


def run(decks: list[Deck], folder: Path, time_limit: float) -> list[RunRecord | RunFailed]:
    """One result per deck, in order; `time_limit` [s] holds for each."""
    code, program = installed(), programs.executable(VARIABLE, PROGRAM)
    if code is None or program is None:
        return missing(decks, "liggghts", VARIABLE, PROGRAM)

    def run_one(deck: Deck, own: Path) -> RunRecord:
        command = [program, "-in", deck.main, "-log", "none", "-echo", "none"]
        wall_time = run_program(command, own, time_limit)
        scene = deck.scene
        types = [particle.material + 1 for particle in scene.particles]
        columns = read_run(own, scene, types, wall_columns(scene), _pairs)
        return record_of(deck, code, wall_time, "synchronized", columns, own, evaluated_anew=True)

    return run_each(decks, folder, (HISTORY, PARTICLES, CONTACTS), run_one)


def _pairs(path: Path, scene: Scene) -> Rows:
    """Contacts between particles; LIGGGHTS lists those in touch, with the force on the first."""
    sample, values = read_entries(path, CONTACT_COLUMNS, scene.sample_steps)
    return pair_rows(path, scene, sample, values[:, :2], values[:, 2:])
