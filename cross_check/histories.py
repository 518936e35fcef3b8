"""Curves of scenes that are no impact of two bodies: the largest vector among all particles over time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cross_check.compare.outcome import NATIVE, Outcome, Outcomes, mirror_name
from cross_check.compare.quantities import QUANTITIES, Quantity, Undefined
from cross_check.engine import Case
from cross_check.record import Array
from cross_check.report.campaign import Curve, CurveSet

# A snapshot has no course over time.
FEWEST_SAMPLES = 3


def histories(case: Case, name: str, outcomes: Outcomes, codes: tuple[str, ...]) -> Iterator[CurveSet]:
    """One figure for every series that the case compares, with each code's distance from its mirror."""
    for wanted in dict.fromkeys(gate.quantity for gate in case.gates):
        quantity = QUANTITIES[wanted]
        if quantity.series is None:
            continue
        found: dict[str, tuple[Outcome, Array]] = {}
        for source in (NATIVE, *(mirror_name(code) for code in codes), *codes):
            outcome = outcomes.get((source, 0))
            values = None if outcome is None else _values(quantity, source, outcome, outcomes)
            if outcome is not None and values is not None and len(values) >= FEWEST_SAMPLES:
                found[source] = outcome, values
        if found:
            yield _figure(name, quantity, found, codes)


def _values(quantity: Quantity, source: str, outcome: Outcome, outcomes: Outcomes) -> Array | None:
    """The series (T, N, 3) of a source; positions as displacements since the first sample."""
    if outcome.record is None or quantity.series is None:
        return None
    mirror = outcomes.get((mirror_name(source), 0)) if quantity.of_law else None
    try:
        values = quantity.series((mirror or outcome).scene, outcome.record)
    except Undefined:
        return None
    return values - values[0] if quantity.name == "position_history" else values


def _largest(vectors: Array) -> Array:
    """The largest length among the particles, shape (T,)."""
    return np.linalg.norm(vectors, axis=2).max(axis=1)


def _figure(name: str, quantity: Quantity, found: dict[str, tuple[Outcome, Array]], codes: tuple[str, ...]) -> CurveSet:
    label = "displacement" if quantity.name == "position_history" else quantity.name.removesuffix("_history")
    lines = [
        Curve(source, _time(outcome), _largest(values), recorded=outcome.origin == "recorded")
        for source, (outcome, values) in found.items()
        if source == NATIVE or source in codes
    ]
    scale = max(float(np.max(_largest(values))) for _, values in found.values())
    pairs = [(code, mirror_name(code)) for code in codes if code in found and mirror_name(code) in found]
    return CurveSet(
        case=name,
        title=f"Largest {label} over time",
        x_label="time",
        x_unit="s",
        y_label=f"largest {label} of a particle",
        y_unit=quantity.unit,
        curves=lines,
        residuals=[_residual(code, mirror, found) for code, mirror in pairs],
        residual_scale=scale or 1.0,
        residual_label="|code - mirror| / peak" if scale else f"|code - mirror| [{quantity.unit}]",
    )


def _time(outcome: Outcome) -> Array:
    return np.empty(0) if outcome.record is None else outcome.record["time"]


def _residual(code: str, mirror: str, found: dict[str, tuple[Outcome, Array]]) -> Curve:
    """The largest difference among the particles at the samples that both have."""
    (here, left), (there, right) = found[code], found[mirror]
    if here.record is None or there.record is None:
        raise Undefined("no record")
    _, mine, other = np.intersect1d(here.record.step, there.record.step, return_indices=True)
    recorded = here.origin == "recorded"
    return Curve(f"{code} - {mirror}", _time(here)[mine], _largest(left[mine] - right[other]), recorded=recorded)
