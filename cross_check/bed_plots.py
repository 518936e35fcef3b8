"""Plots of beds for the report: observables over time and over the seeds, profiles, for native and every code."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cross_check.compare.ensemble_checks import LAST, Bed, beds, curves
from cross_check.compare.outcome import NATIVE
from cross_check.compare.quantity import Undefined
from cross_check.compare.samples import BadSample
from cross_check.engine import Case
from cross_check.report.campaign import Curve, CurveSet, SweepPlot
from cross_check.runs import Results

# Times of a drawn curve: more than a page can show add nothing.
DRAWN = 400


def bed_curves(case: Case, results: Results, codes: tuple[str, ...]) -> Iterator[CurveSet]:
    """Ensemble means over time for every curve that is judged, and their distance from native over the margin."""
    for bed in beds(case, results, codes):
        for gate in bed.gates:
            if gate.check == "equivalence_curve":
                found = _over_time(bed, gate.quantity, gate.bound)
                if found is not None:
                    yield found
        yield from _profiles(bed)


def _present(bed: Bed, name: str) -> list[str]:
    """The sources that have an observable for all seeds."""
    found: list[str] = []
    for source in (NATIVE, *bed.codes):
        try:
            if all(name in member.series for member in bed.ensemble(source).members):
                found.append(source)
        except Undefined:
            continue
    return found


def _over_time(bed: Bed, name: str, margin: float) -> CurveSet | None:
    sources = _present(bed, name)
    if NATIVE not in sources:
        return None
    try:
        times, groups = curves(bed, name, *sources)
    except (Undefined, BadSample):
        return None
    chosen = slice(None, None, max(1, len(times) // DRAWN))
    means = {source: group.mean(axis=0)[chosen] for source, group in zip(sources, groups, strict=True)}
    shown = times[chosen]
    return CurveSet(
        case=bed.name,
        title=f"{name.replace('_', ' ')}, mean of {len(bed.scenes)} seeds",
        x_label="time",
        x_unit="s",
        y_label=name.replace("_", " "),
        y_unit=bed.unit(name),
        curves=[Curve(source, shown, mean, bed.recorded(source)) for source, mean in means.items()],
        residuals=[
            Curve(f"{source} - {NATIVE}", shown, mean - means[NATIVE], bed.recorded(source))
            for source, mean in means.items()
            if source != NATIVE
        ],
        residual_scale=margin,
        residual_label="|code - native| / margin",
    )


def _profiles(bed: Bed) -> Iterator[CurveSet]:
    """Every observable that is a list of numbers, at the end of its stage, mean of the first seed."""
    for stated in bed.scenes[0].observables:
        name = stated["name"]
        lines: list[Curve] = []
        for source in (NATIVE, *bed.codes):
            record = bed.of(source)[0].measured
            if record is None or name not in record.series or record[name].ndim != 2:
                continue
            values = record.values(name, stated["stage"], max(float(stated["average"]), LAST))
            parts = np.arange(len(values), dtype=np.float64) + 0.5
            lines.append(Curve(source, parts, values, bed.recorded(source)))
        # An empty part of a profile has no value in some codes: it is left out of all curves.
        whole = np.all([np.isfinite(line.y) for line in lines], axis=0)
        lines = [replace(line, x=line.x[whole], y=line.y[whole]) for line in lines]
        if lines and len(lines[0].x) == 0:
            continue
        if lines and lines[0].source == NATIVE:
            scale = float(np.max(np.abs(lines[0].y))) or 1.0
            yield CurveSet(
                case=bed.name,
                title=f"{name.replace('_', ' ')}, first seed",
                x_label="part",
                x_unit="-",
                y_label=name.replace("_", " "),
                y_unit=bed.unit(name),
                curves=lines,
                residuals=[
                    Curve(f"{line.source} - {NATIVE}", line.x, line.y - lines[0].y, line.recorded) for line in lines[1:]
                ],
                residual_scale=scale,
                residual_label="|code - native| / largest",
            )


def bed_seeds(case: Case, results: Results, codes: tuple[str, ...]) -> Iterator[SweepPlot]:
    """Every observable that is judged, seed by seed, and its distance from the mean of native."""
    for bed in beds(case, results, codes):
        for name in dict.fromkeys(gate.quantity for gate in bed.gates if gate.check != "equivalence_curve"):
            values: dict[str, np.ndarray[tuple[int], np.dtype[np.float64]]] = {}
            for source in (NATIVE, *bed.codes):
                try:
                    values[source] = bed.values(source, name)
                except Undefined:
                    continue
            if NATIVE not in values or len(values[NATIVE]) < 2:
                continue
            seeds = np.array([float(scene.seed or 0) for scene in bed.scenes])
            mean = float(np.mean(values[NATIVE]))
            yield SweepPlot(
                case=case.name,
                title=f"{name.replace('_', ' ')} of every seed" + (f", {bed.variant}" if bed.variant else ""),
                x_label="seed [-]",
                y_label=f"{name.replace('_', ' ')} [{bed.unit(name)}]",
                points=[Curve(source, seeds, found, bed.recorded(source)) for source, found in values.items()],
                residuals=[Curve(f"{source} - mean of native", seeds, v - mean) for source, v in values.items()],
            )
