"""Figures over time: temperature and stiffness (8), density (9), coordination (10), reorganisation (11)."""

from __future__ import annotations

import numpy as np

from cross_check.record import Array
from cross_check.report.palette import DASHED, LIGHT, SOLID
from cross_check.sintering import plan
from cross_check.sintering.outcome import Arrays
from cross_check.sintering.plots import Line, Panel, Sheet, mean_and_spread, timed
from cross_check.sintering.study import Sample, Study

KELVIN = 273.15
# Time at which the walls have pressed the particles together [s].
SETTLED = 0.1
# Figure 11 draws the coordination number over so much.
SCALE = 5.0


def figures(study: Study) -> list[Sheet]:
    """Figures 8 to 11."""
    size = largest(study)
    return [_stiffness(study, size), _density(study, size), _coordination(study), _reorganisation(study, size)]


def largest(study: Study) -> int:
    """The number of disks of the paper's figures: 300, or 100 in the quick form."""
    return max(run.count for run in study.outcomes)


def times(study: Study, count: int) -> list[float]:
    """The sintering times of the plain samples [s]."""
    found = {run.sintering_time for run in study.outcomes if run.count == count and run.mode == plan.PLAIN}
    return sorted(time for time in found if time is not None)


def whole(study: Study, sample: Sample, name: str) -> tuple[Array, list[Array]]:
    """A series of every seed from the start to the end of relaxation, and its times [s]."""
    curves: list[Array] = []
    at: Array = np.zeros(0)
    for seed in study.seeds(plan.COOLED, sample):
        box = study.outcome(plan.BOX, sample, seed).arrays
        cooled = study.outcome(plan.COOLED, sample, seed).arrays
        until = float(box["time"][box["hot_samples"][0]]) + sample.time
        before = box["time"] < until - 1e-9
        curves.append(np.concatenate([box[name][before], cooled[name]]))
        at = np.concatenate([box["time"][before], _from(cooled, until)])
    return at, curves


def _from(arrays: Arrays, start: float) -> Array:
    return arrays["time"] - arrays["time"][0] + start


def _stiffness(study: Study, size: int) -> Sheet:
    """Temperature and k1 of the samples at p = 100 N/m: they are the same at every pressure."""
    temperature: list[Line] = []
    stiffness: list[Line] = []
    for time in times(study, size):
        sample = Sample(100, size, time)
        at, curves = whole(study, sample, "temperature")
        temperature.append(timed(time, at, [curves[0] - KELVIN]))
        at, curves = whole(study, sample, "k1")
        stiffness.append(timed(time, at, [curves[0] / float(study.law["k1"])]))
    panels = [
        Panel("", "time [s]", "temperature [\N{DEGREE SIGN}C]", temperature),
        Panel("", "time [s]", "k1(T,t) / k1 [-]", stiffness),
    ]
    return Sheet("figure-08", "Figure 8: temperature and stiffness", panels)


def _density(study: Study, size: int) -> Sheet:
    panels: list[Panel] = []
    for pressure in (100, 10):
        lines = [timed(time, *whole(study, Sample(pressure, size, time), "nu_geo")) for time in times(study, size)]
        limits = _settled(lines)
        panels.append(Panel(f"N = {size}, p = {pressure} N/m", "time [s]", "density [-]", lines, y_limits=limits))
    return Sheet("figure-09", "Figure 9: density", panels)


def _settled(lines: list[Line]) -> tuple[float, float]:
    """Limits that show what follows once the walls have met the particles: the loose start would flatten it."""
    shown: list[Array] = []
    for line in lines:
        later = line.x >= SETTLED
        band = np.zeros(1) if line.band is None else line.band[later]
        shown += [line.y[later] - band, line.y[later] + band]
    values = np.concatenate(shown)
    margin = 0.1 * max(float(np.ptp(values)), 0.01)
    return float(np.min(values)) - margin, float(np.max(values)) + margin


def _coordination(study: Study) -> Sheet:
    panels: list[Panel] = []
    for size in sorted({run.count for run in study.outcomes if run.test == plan.COOLED}):
        lines: list[Line] = []
        for pressure, color, dash in ((10, LIGHT["native"], DASHED), (100, LIGHT["liggghts"], SOLID)):
            at, curves = whole(study, Sample(pressure, size), "C")
            lines.append(Line(f"p = {pressure} N/m", at, *mean_and_spread(curves), color, dash))
        panels.append(
            Panel(f"N = {size}, t_s = 1 s", "time [s]", "coordination number [-]", lines, y_limits=(0.0, 6.0))
        )
    return Sheet("figure-10", "Figure 10: coordination number", panels)


def _reorganisation(study: Study, size: int) -> Sheet:
    """One run of each pressure: a mean over seeds would hide the events."""
    panels: list[Panel] = []
    for pressure in (100, 10):
        sample = Sample(pressure, size)
        seed = study.seeds(plan.BOX, sample)[0]
        arrays = study.outcome(plan.BOX, sample, seed).arrays
        hot = arrays["hot_samples"]
        at = arrays["time"][hot]
        lines = [
            Line("density", at, arrays["nu_geo"][hot], color=LIGHT["native"], marker="s"),
            Line(f"coordination / {SCALE:g}", at, arrays["C"][hot] / SCALE, color=LIGHT["yade"], marker="o"),
            Line("wall stress / p", at, arrays["sigma_zz"][hot] / pressure, color=LIGHT["liggghts"]),
        ]
        panels.append(Panel(f"N = {size}, p = {pressure} N/m, seed {seed}", "time [s]", "[-]", lines))
    return Sheet("figure-11", "Figure 11: density, coordination and wall stress while sintering", panels)
