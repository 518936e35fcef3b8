"""Curves and sweeps for the report: force over time and overlap, scalars over the points of a sweep."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cross_check import reference
from cross_check.compare.outcome import NATIVE, Outcome, Outcomes, mirror_name
from cross_check.compare.quantities import QUANTITIES, Impact, Undefined, impact
from cross_check.engine import Case, Gate, Variant
from cross_check.report.campaign import Curve, CurveSet, SweepPlot
from cross_check.runs import Results

# Above this number of variants that ran, three of them stand for all.
MOST_VARIANTS = 6


def curves(name: str, outcomes: Outcomes, codes: tuple[str, ...]) -> Iterator[CurveSet]:
    """Force over time and over overlap of an impact, with each code's distance from its mirror."""
    found: dict[str, tuple[Outcome, Impact]] = {}
    for source in (NATIVE, *(mirror_name(code) for code in codes), *codes):
        outcome = outcomes.get((source, 0))
        if outcome is None or outcome.record is None:
            continue
        try:
            found[source] = outcome, impact(outcome.scene, outcome.record)
        except Undefined:
            return
    if not found:
        return
    scale = max(float(np.max(np.abs(view.force))) for _, view in found.values())
    if scale == 0.0:
        return
    for title, x_label, x_unit in (("Force over time", "time", "s"), ("Force over overlap", "overlap", "m")):
        lines = [_line(source, *found[source], x_label) for source in (NATIVE, *codes) if source in found]
        residuals = [_residual(code, found, x_label) for code in codes if code in found and mirror_name(code) in found]
        yield CurveSet(
            case=name,
            title=title,
            x_label=x_label,
            x_unit=x_unit,
            y_label="normal force",
            y_unit="N",
            curves=lines,
            residuals=residuals,
            residual_scale=scale,
            residual_label="|code - mirror| / peak",
        )


def _line(source: str, outcome: Outcome, view: Impact, axis: str) -> Curve:
    x = view.time if axis == "time" else view.overlap
    inside = np.ones(len(x), dtype=bool) if axis == "time" else _near_contact(view)
    return Curve(source, x[inside], view.force[inside], recorded=outcome.origin == "recorded")


def _near_contact(view: Impact) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Samples in contact and one on either side: free flight has no place on the axis of overlap."""
    inside = view.overlap > 0.0
    return inside | np.append(inside[1:], False) | np.insert(inside[:-1], 0, False)


def _residual(code: str, found: dict[str, tuple[Outcome, Impact]], axis: str) -> Curve:
    outcome, view = found[code]
    mirror_outcome, mirror = found[mirror_name(code)]
    if outcome.record is None or mirror_outcome.record is None:
        raise Undefined("no record")
    common = np.intersect1d(outcome.record.step, mirror_outcome.record.step)
    here, there = np.isin(outcome.record.step, common), np.isin(mirror_outcome.record.step, common)
    x = (view.time if axis == "time" else view.overlap)[here]
    y = view.force[here] - mirror.force[there]
    inside = np.ones(len(x), dtype=bool) if axis == "time" else x > 0.0
    label = f"{code} - {mirror_name(code)}"
    return Curve(label, x[inside], y[inside], recorded=outcome.origin == "recorded")


def drawn(case: Case, results: Results) -> list[str]:
    """The scenes of a case whose curves are drawn: all that ran, or the first, middle and last of many."""
    names = [variant.scenes[0].name for variant in case.variants]
    ran = [name for name in names if any(outcome.record is not None for outcome in results[name].values())]
    return ran if len(ran) <= MOST_VARIANTS else [ran[0], ran[len(ran) // 2], ran[-1]]


def sweeps(case: Case, results: Results, codes: tuple[str, ...]) -> Iterator[SweepPlot]:
    """For every scalar with a closed form: value and distance from it over each axis that has positions.

    What conservation makes zero has no curve.
    """
    axes = {point.axis for variant in case.variants for point in variant.points if point.at is not None}
    gates = [
        gate
        for gate in case.gates
        if gate.check in ("reference", "finest", "extrapolated")
        and gate.reference != "conservation.zero"
        and QUANTITIES[gate.quantity].scalar
    ]
    for axis in sorted(axes):
        others = {_others(variant, axis) for variant in case.variants}
        for gate in gates:
            for other in sorted(others):
                plot = _sweep(case, gate, axis, other, results, codes)
                if plot is not None:
                    yield plot


def _others(variant: Variant, axis: str) -> str:
    labels = [point.label for point in variant.points if point.axis != axis]
    seed = variant.scenes[0].seed
    return ", ".join(labels if seed is None else [*labels, f"seed={seed}"])


def _sweep(case: Case, gate: Gate, axis: str, other: str, results: Results, codes: tuple[str, ...]) -> SweepPlot | None:
    formula, form = QUANTITIES[gate.quantity].scalar, reference.closed_forms().get(gate.reference or "")
    if formula is None or form is None:
        return None
    values: dict[str, list[tuple[float, float, float]]] = {}
    targets: list[tuple[float, float]] = []
    for variant in case.variants:
        at = next((point.at for point in variant.points if point.axis == axis), None)
        if at is None or _others(variant, axis) != other:
            continue
        outcomes = results[variant.scenes[0].name]
        if all(outcome.record is None for outcome in outcomes.values()):
            continue
        target = float(form(variant.scenes[0]))
        targets.append((at, target))
        for source in (NATIVE, *codes):
            outcome = outcomes.get((source, 0))
            if outcome is None or outcome.record is None:
                continue
            try:
                value = formula(outcome.scene, outcome.record)
            except Undefined:
                continue
            values.setdefault(source, []).append((at, value, value - target))
    if len(targets) < 2:
        return None
    table = {source: np.array(rows) for source, rows in values.items()}
    line = np.array(targets)
    return SweepPlot(
        case=case.name,
        title=f"{gate.quantity.replace('_', ' ')} over {axis.partition(' [')[0]}" + (f", {other}" if other else ""),
        x_label=axis if axis.endswith("]") else f"{axis} [-]",
        y_label=f"{gate.quantity.replace('_', ' ')} [{QUANTITIES[gate.quantity].unit}]",
        points=[Curve("reference", line[:, 0], line[:, 1])]
        + [Curve(source, rows[:, 0], rows[:, 1]) for source, rows in table.items()],
        residuals=[Curve(f"{source} - reference", rows[:, 0], rows[:, 2]) for source, rows in table.items()],
    )
