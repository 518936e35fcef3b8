"""What became of one source of one scene: a record, or the reason why there is none."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cross_check.adapters.interface import Deck
from cross_check.measured import Measured
from cross_check.record import Header, RunRecord
from cross_check.scene import Scene

NATIVE = "native"


def mirror_name(code: str) -> str:
    """The source name of the mirror of a code."""
    return f"{NATIVE}[{code}]"


@dataclass(frozen=True)
class Outcome:
    """One source of one scene.

    `measured` stands in place of `record` where an ensemble is judged: trajectories of beds are not kept. `verdict` is
    empty where there is either, else `not-comparable(...)` or `not-run(...)`. `origin` is `live`,
    `cache`, `recorded` or `not run`. `scene` is the scene that this source ran: a mirror's differs in its options.
    `folder` holds the record, under the source name of whoever ran it first.
    """

    source: str
    scene: Scene
    record: RunRecord | None
    verdict: str = ""
    origin: str = "live"
    deck: Deck | None = None
    folder: Path | None = None
    note: str = ""
    measured: Measured | None = None

    @property
    def header(self) -> Header | None:
        """The header of what there is, or None."""
        found = self.record or self.measured
        return None if found is None else found.header


Outcomes = dict[tuple[str, int], Outcome]
"""Outcomes of one variant by source and refinement."""
