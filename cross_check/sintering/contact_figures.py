"""Distributions over the contacts: overlaps hot (12) and cooled (13), normal forces at both pressures (14, 15)."""

from __future__ import annotations

import numpy as np

from cross_check.record import Array
from cross_check.sintering import plan
from cross_check.sintering.course_figures import largest, times
from cross_check.sintering.plots import Line, Panel, Sheet, timed
from cross_check.sintering.study import Sample, Study

BINS = 40
# The range holds this share of all contacts: a few outliers would stretch it.
SHOWN = 0.995
STATES = {"hot": "after sintering", "final": "after cool-down and relaxation"}


def figures(study: Study) -> list[Sheet]:
    """Figures 12 to 15."""
    return [
        _overlaps(study, "figure-12", "hot", "Figure 12: overlaps after sintering"),
        _overlaps(study, "figure-13", "final", "Figure 13: overlaps after cool-down"),
        _forces(study, "figure-14", 10),
        _forces(study, "figure-15", 100),
    ]


def _found(study: Study, sample: Sample, name: str) -> list[Array]:
    """An array over the contacts for every seed."""
    return [study.outcome(plan.COOLED, sample, seed).arrays[name] for seed in study.seeds(plan.COOLED, sample)]


def densities(found: list[Array], edges: Array) -> list[Array]:
    """Probability densities of every seed over bins; of all contacts, also of those outside of the bins."""
    width = np.diff(edges)
    return [np.histogram(values, edges)[0] / (max(len(values), 1) * width) for values in found]


def _lines(study: Study, pressure: int, name: str, *, symmetric: bool) -> list[Line]:
    """The distribution at every sintering time, over the bins of the widest."""
    size = largest(study)
    by_time = {time: _found(study, Sample(pressure, size, time), name) for time in times(study, size)}
    high = max(_reach(found) for found in by_time.values())
    edges = np.linspace(-high if symmetric else 0.0, high, BINS + 1)
    centers = 0.5 * (edges[1:] + edges[:-1])
    return [timed(time, centers, densities(found, edges)) for time, found in by_time.items()]


def _reach(found: list[Array]) -> float:
    values = np.abs(np.concatenate(found))
    return (float(np.quantile(values, SHOWN)) if len(values) else 0.0) or 1.0


def _overlaps(study: Study, name: str, state: str, title: str) -> Sheet:
    panels = [
        Panel(
            f"N = {largest(study)}, p = {pressure} N/m, {STATES[state]}",
            "overlap / (a1 + a2) [-]",
            "probability density [-]",
            _lines(study, pressure, f"{state}_overlaps", symmetric=False),
            log_y=True,
        )
        for pressure in (10, 100)
    ]
    return Sheet(name, title, panels)


def _forces(study: Study, name: str, pressure: int) -> Sheet:
    panels = [
        Panel(
            f"N = {largest(study)}, p = {pressure} N/m, {words}",
            "normal force / (2 a0 p) [-], repulsion positive",
            "probability density [-]",
            _lines(study, pressure, f"{state}_forces", symmetric=True),
            log_y=True,
        )
        for state, words in STATES.items()
    ]
    return Sheet(name, f"Figure {name[-2:]}: normal forces, p = {pressure} N/m", panels)
