"""Recorded runs: refreshed from the installed codes, as a diff to review."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from cross_check import reference, regression, runs
from cross_check.adapters import ADAPTERS
from cross_check.cache import Cache
from cross_check.engine import Case, CaseError
from cross_check.measured import read as read_measured
from cross_check.record import read

# Particles of the largest record that is stored: those of packings are a megabyte each, and run live.
LARGEST = 64


def refresh(cases: list[Case], progress: runs.Progress) -> tuple[int, int]:
    """Stores the runs of every installed code and removes those of decks that no case asks for any more.

    Returns the numbers of stored and of removed records. Raises CaseError where a run fails.
    """
    codes = tuple(name for name, adapter in ADAPTERS.items() if adapter.installed() is not None)
    if not codes:
        raise CaseError("no external code is installed: there is nothing to record")
    with tempfile.TemporaryDirectory(prefix="crossgrain-") as work:
        results = runs.execute(cases, runs.Options(codes=codes, recorded=False), Cache(), Path(work), progress)
    kept: set[Path] = set()
    for outcomes in results.values():
        for (source, _), outcome in outcomes.items():
            if source not in codes or outcome.deck is None:
                continue
            if outcome.measured is not None:
                kept.add(reference.store_measured(outcome.measured, outcome.scene))
                continue
            if outcome.record is not None and len(outcome.record.header.mass) > LARGEST:
                continue
            if outcome.record is None:
                raise CaseError(f"{outcome.scene.name}, {source}: {outcome.verdict}")
            kept.add(reference.store(outcome.record, source))
    regression.record(cases, results, codes)
    return len(kept), _prune(codes, {case.name for case in cases}, kept)


def _prune(codes: tuple[str, ...], names: set[str], kept: set[Path]) -> int:
    """Removes records of the same cases and codes whose decks are gone."""
    removed = 0
    for code in codes:
        for path in (reference.FOLDER / "recorded" / code).glob("*/*/record.json"):
            if path.parent not in kept and read(path.parent).header.case in names:
                shutil.rmtree(path.parent)
                removed += 1
        for path in (reference.FOLDER / "recorded" / code).glob("*/measured/*/measured.json"):
            if path.parent not in kept and read_measured(path.parent).header.case in names:
                shutil.rmtree(path.parent)
                removed += 1
    return removed
