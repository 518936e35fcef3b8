"""Rows of the table as verdicts of the house, with what is expected of them."""

from __future__ import annotations

import math
from pathlib import Path

from cross_check.compare.expectations import expect, rules
from cross_check.compare.verdicts import AGREE, DIFFER, FULL_ONLY, Comparison, Side, not_run
from cross_check.sintering.targets import FAILED, LEFT_OUT, MET, MISSED, Row

SUITE = "sintering"
# Expected verdicts of the two forms: one seed of the small samples may miss what the mean of three keeps.
EXPECTED = {full: Path(__file__).with_name(f"expected_{'full' if full else 'quick'}.toml") for full in (False, True)}
_SOURCE = "threshold set for the claim of the paper"


def comparisons(rows: list[Row], full: bool, expected: Path | None = None) -> list[Comparison]:
    """The rows that have a threshold, each with the verdict expected of it. Raises ExpectationError."""
    found = [_comparison(row) for row in rows if row.target.gated]
    table = rules(EXPECTED[full] if expected is None else expected)
    return expect(found, table, {SUITE}, complete=True)


def _comparison(row: Row) -> Comparison:
    target, evidence = row.target, row.evidence
    value = None if evidence is None else evidence.value
    limit = _nearest(row)
    error = None if row.spread is None or evidence is None else row.spread / math.sqrt(len(evidence.seeds))
    return Comparison(
        case=f"{SUITE}/p={target.sample.pressure},N={target.sample.count}",
        level="L5",
        check="target",
        quantity=target.id,
        unit=target.unit,
        left=Side("native", value, error, "none" if error is None else "scatter over seeds"),
        right=Side("threshold", limit, None),
        discrepancy=None if value is None else target.outside(value),
        scale="absolute",
        bound=0.0,
        bound_source=f"{_SOURCE}: {target.threshold}",
        verdict=_verdict(row),
        expected="",
        note=note(row),
    )


def _verdict(row: Row) -> str:
    if row.verdict == LEFT_OUT:
        return FULL_ONLY
    return {MET: AGREE, MISSED: DIFFER, FAILED: not_run(row.reason)}[row.verdict]


def _nearest(row: Row) -> float | None:
    """The limit that stands in the table of verdicts: the one that the value is nearest to."""
    limits = [limit for limit in (row.target.low, row.target.high) if limit is not None]
    if row.evidence is None or not math.isfinite(row.evidence.value):
        return limits[0]
    value = row.evidence.value
    return min(limits, key=lambda limit: abs(limit - value))


def note(row: Row) -> str:
    """Claim, paper, and what the seeds do."""
    target = row.target
    parts = [target.claim, f"paper: {target.paper}"]
    if row.evidence is not None:
        seeds = ", ".join(f"{value:.4g}" for value in row.evidence.seeds)
        parts.append(
            f"seeds: {seeds}" + (f"; {row.kept_by} of {len(row.evidence.seeds)} keep it" if target.gated else "")
        )
        parts += [row.evidence.note] if row.evidence.note else []
    parts += [row.reason] if row.reason else []
    return "\n".join(parts)
