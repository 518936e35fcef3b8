"""Figures of the compression test: density (16, 18) and stress (17, 19) over strain, and the strength."""

from __future__ import annotations

import numpy as np

from cross_check.record import Array
from cross_check.report.palette import DASHED, INK, LIGHT
from cross_check.sintering import plan
from cross_check.sintering.course_figures import times
from cross_check.sintering.plots import Line, Panel, Sheet, mean_and_spread, timed
from cross_check.sintering.study import Sample, Study

POINTS = 200
SIZES = {100: ("figure-16", "figure-17"), 300: ("figure-18", "figure-19")}


def figures(study: Study) -> list[Sheet]:
    """Figures 16 to 19, those of the sizes that ran, and one that the paper does not have."""
    sheets: list[Sheet] = []
    for size in sorted({run.count for run in study.outcomes if run.test == plan.COMPRESSION}):
        density, stress = SIZES[size]
        sheets.append(_over_strain(study, size, density, "nu_geo", "density [-]"))
        sheets.append(_over_strain(study, size, stress, "sigma_zz", "stress on the top wall [N/m]"))
    return [*sheets, _strength(study)]


def curves(study: Study, sample: Sample, name: str, grid: Array) -> list[Array]:
    """A series of every seed over the strains of `grid`."""
    found: list[Array] = []
    for seed in study.seeds(plan.COMPRESSION, sample):
        arrays = study.outcome(plan.COMPRESSION, sample, seed).arrays
        found.append(np.interp(grid, arrays["strain"], arrays[name]))
    return found


def _over_strain(study: Study, size: int, name: str, quantity: str, label: str) -> Sheet:
    panels: list[Panel] = []
    for pressure in (10, 100):
        lines: list[Line] = []
        for time in times(study, size):
            sample = Sample(pressure, size, time)
            ends = study.values("compression.strain_end", sample)
            grid = np.linspace(0.0, min(ends.values()), POINTS)
            lines.append(timed(time, grid, curves(study, sample, quantity, grid)))
        if quantity == "sigma_zz":
            lines.append(_slope(study, Sample(pressure, size)))
        panels.append(Panel(f"N = {size}, p = {pressure} N/m", "vertical strain [-]", label, lines))
    words = "density" if quantity == "nu_geo" else "vertical stress"
    return Sheet(name, f"Figure {name[-2:]}: {words} under compression, N = {size}", panels)


def _slope(study: Study, sample: Sample) -> Line:
    """The stiffness of the longest sintered samples as a straight line, up to their mean strength."""
    stiffness = float(np.mean(list(study.values("compression.stiffness", sample).values())))
    strength = float(np.mean(list(study.values("compression.failure_stress", sample).values())))
    rise = (strength - sample.pressure) / stiffness
    x, y = np.array([0.0, rise]), np.array([float(sample.pressure), strength])
    return Line(f"{stiffness:.3g} N/m", x, y, color=INK, dash=DASHED)


def _strength(study: Study) -> Sheet:
    """Failure stress and strain over the sintering time."""
    looks = {
        (10, 100): (LIGHT["yade"], "o"),
        (100, 100): (LIGHT["native"], "s"),
        (10, 300): (LIGHT["other-1"], "^"),
        (100, 300): (LIGHT["liggghts"], "D"),
    }
    panels: list[Panel] = []
    for quantity, label in (("failure_stress", "failure stress [N/m]"), ("failure_strain", "failure strain [-]")):
        lines: list[Line] = []
        for (pressure, size), (color, marker) in looks.items():
            found = times(study, size) if any(run.count == size for run in study.outcomes) else []
            values = [study.values(f"compression.{quantity}", Sample(pressure, size, time)) for time in found]
            if values:
                seeds = [np.array([at[seed] for at in values]) for seed in values[0]]
                mean, band = mean_and_spread(seeds)
                label_of = f"p = {pressure} N/m, N = {size}"
                lines.append(Line(label_of, np.array(found), mean, band, color, marker=marker, points=True))
        panels.append(Panel("", "sintering time [s]", label, lines, log_x=True, log_y=quantity == "failure_stress"))
    return Sheet("strength", "Strength over the sintering time", panels)
