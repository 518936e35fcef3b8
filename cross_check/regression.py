"""Baselines of campaigns: what the ensembles of a case gave, compared with what was recorded of them before."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime, timezone
from pathlib import Path

from cross_check import baseline, engine
from cross_check.baseline import Baseline
from cross_check.compare.changes import BaselineChanges, Trend, compare_baselines, trends
from cross_check.compare.ensemble_checks import LAST, Bed, beds
from cross_check.compare.outcome import NATIVE
from cross_check.compare.quantity import Undefined
from cross_check.engine import Case
from cross_check.ensembles import Ensemble
from cross_check.record import RecordError
from cross_check.runs import Results


def _measures(found: Iterable[Bed]) -> list[tuple[str, str, float]]:
    """Observables that are numbers, with their stage and average."""
    measures: dict[tuple[str, str, float], None] = {}
    for bed in found:
        # A difference of two observables changes with them.
        for stated in (item for item in bed.scenes[0].observables if item.get("minus") is None):
            measures[stated["name"], stated["stage"], max(float(stated["average"]), LAST)] = None
    return list(measures)


def _defined(ensembles: list[Ensemble], measure: tuple[str, str, float]) -> bool:
    """Whether every ensemble has a number for a measure."""
    try:
        for ensemble in ensembles:
            ensemble.values(*measure)
    except RecordError:
        return False
    return True


def present(case: Case, results: Results, codes: tuple[str, ...]) -> Baseline | None:
    """The baseline of what a campaign found of a case, by the date of today; None where it has no whole ensemble."""
    found = list(beds(case, results, codes))
    ensembles: list[Ensemble] = []
    for bed in found:
        for source in (NATIVE, *codes):
            try:
                ensembles.append(bed.ensemble(source))
            except Undefined:
                continue
    measures = [measure for measure in _measures(found) if _defined(ensembles, measure)]
    if not ensembles or not measures:
        return None
    today = datetime.now(timezone.utc).date().isoformat()
    return baseline.capture(ensembles, measures, today, engine.version())


def changes(
    cases: Iterable[Case], results: Results, codes: tuple[str, ...]
) -> tuple[list[BaselineChanges], list[Trend]]:
    """What changed of every case since its newest baseline, and the trends over all baselines and the present."""
    changed: list[BaselineChanges] = []
    over_time: list[Trend] = []
    for case in cases:
        before = baseline.recorded(case.name)
        now = present(case, results, codes) if before else None
        if now is not None:
            changed.append(compare_baselines(before[-1], now))
            over_time += trends([*before, now])
    return changed, over_time


def record(cases: Iterable[Case], results: Results, codes: tuple[str, ...]) -> list[Path]:
    """Writes the baseline of every case that has ensembles; returns the files."""
    written: list[Path] = []
    for case in cases:
        now = present(case, results, codes)
        if now is not None:
            path = baseline.path_of(now)
            baseline.write(now, path)
            written.append(path)
    return written
