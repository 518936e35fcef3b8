"""Lays out one figure: values above, their differences on a log axis below, the key at the right."""

# pyright: reportUnknownMemberType=false
# matplotlib leaves the keywords of its methods untyped.

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from cross_check.record import Array
from cross_check.report import notation
from cross_check.report.palette import look
from cross_check.report.thinning import Drawn

SIZE = (6.9, 3.7)  # inches
LEFT, RIGHT, BOTTOM, TOP = 0.095, 0.625, 0.115, 0.965  # of the figure
SPLIT = (0.36, 0.44)  # of the height between BOTTOM and TOP: top of the differences, bottom of the values
LABEL_AT = -0.12  # of the width of the axes
KEY_LEFT, KEY_SAMPLE, KEY_PITCH, KEY_POINTS = 0.643, 0.04, 0.044, 7.0  # of the figure, points
DECADES_BELOW_PEAK = 3.0  # of the smallest difference that the log axis still shows
MARKS_PER_CURVE = 7
TICKS = 6
WIDE_X, WIDE_Y = 50.0, 1e3  # ratio of largest and smallest value from which a sweep has a log axis [-]


@dataclass(frozen=True)
class Job:
    """One figure to draw: thinned curves, labels with units, and where its files go (`stem` without suffix)."""

    stem: Path
    scene: str
    title: str
    x_label: str
    y_label: str
    residual_label: str
    curves: list[Drawn]
    residuals: list[Drawn]
    sweep: bool
    pdf: bool


def figure(job: Job) -> Figure:
    """The figure of a job, not yet written."""
    sheet = Figure(figsize=SIZE)
    height, width = TOP - BOTTOM, RIGHT - LEFT
    split = SPLIT if job.residuals else (0.0, 0.0)
    above = sheet.add_axes((LEFT, BOTTOM + split[1] * height, width, (1.0 - split[1]) * height))
    _draw_values(sheet, above, job)
    lowest = above
    if job.residuals:
        lowest = sheet.add_axes((LEFT, BOTTOM, width, split[0] * height), sharex=above)
        _draw_residuals(sheet, lowest, job)
        above.tick_params(labelbottom=False)
        above.xaxis.offsetText.set_visible(False)
    lowest.set_xlabel(job.x_label)
    for axes in (above, lowest):  # by hand: matplotlib would lay out all labels once more to align them
        axes.yaxis.set_label_coords(LABEL_AT, 0.5)
    return sheet


def _draw_values(sheet: Figure, axes: Axes, job: Job) -> None:
    for place, drawn in enumerate(job.curves):
        _line(axes, drawn, drawn.y, _marks(drawn, place, len(job.curves), job.sweep))
    axes.set_ylabel(job.y_label)
    axes.locator_params(nbins=TICKS)
    _log_where_wide(axes, job)
    labels = [f"{drawn.source} (recorded)" if drawn.recorded else drawn.source for drawn in job.curves]
    _key(sheet, axes, job.curves, labels)


def _draw_residuals(sheet: Figure, axes: Axes, job: Job) -> None:
    axes.set_yscale("log")
    low, high = _log_limits(job.residuals)
    labels: list[str] = []
    for place, drawn in enumerate(job.residuals):
        y = np.where(np.isfinite(drawn.y), np.maximum(drawn.y, low), np.nan)
        _line(axes, drawn, y, _marks(drawn, place, len(job.residuals), job.sweep))
        peak = "= 0" if drawn.peak == 0 else f"≤ {notation.short(drawn.peak)}"
        labels.append(f"{drawn.source} {peak}")
    axes.set_ylim(low, high)
    axes.set_ylabel(job.residual_label)
    _plain_log(axes, "y", TICKS)
    _key(sheet, axes, job.residuals, labels)


def _stroke(source: str) -> dict[str, Any]:
    style = look(source)
    return {
        "color": style.color,
        "linestyle": style.dash,
        "linewidth": style.width,
        "marker": style.marker,
        "markerfacecolor": "none",
    }


def _line(axes: Axes, drawn: Drawn, y: Array, marks: slice) -> None:
    order = 2 + look(drawn.source).order
    axes.plot(drawn.x, y, markevery=marks, zorder=order, **_stroke(drawn.source))


def _marks(drawn: Drawn, place: int, count: int, sweep: bool) -> slice:
    """Which points carry a marker: all of a sweep, a few of a dense curve, staggered between the sources."""
    if sweep and len(drawn.x) <= 4 * MARKS_PER_CURVE:
        return slice(None)
    every = max(len(drawn.x) // MARKS_PER_CURVE, 1)
    return slice((place * every) // max(count, 1), None, every)


def _log_limits(residuals: list[Drawn]) -> tuple[float, float]:
    peaks = [drawn.peak for drawn in residuals if np.isfinite(drawn.peak) and drawn.peak > 0]
    if not peaks:
        return 1e-18, 1e-15
    low = 10.0 ** (np.floor(np.log10(min(peaks))) - DECADES_BELOW_PEAK)
    return max(low, 1e-300), max(peaks) * 3


def _log_where_wide(axes: Axes, job: Job) -> None:
    """Log axes for a sweep over decades."""
    if not job.sweep or not job.curves:
        return
    x = np.concatenate([drawn.x[np.isfinite(drawn.x)] for drawn in job.curves])
    y = np.concatenate([drawn.y[np.isfinite(drawn.y)] for drawn in job.curves])
    if _is_wide(x, WIDE_X):
        axes.set_xscale("log")
        _plain_log(axes, "x", TICKS)
    if _is_wide(y, WIDE_Y):
        axes.set_yscale("log")
        _plain_log(axes, "y", TICKS)


def _is_wide(values: Array, ratio: float) -> bool:
    return bool(values.size and values.min() > 0 and values.max() > ratio * values.min())


def _plain_log(axes: Axes, name: str, ticks: int) -> None:
    axis = axes.xaxis if name == "x" else axes.yaxis
    axis.set_major_locator(LogLocator(numticks=ticks))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(_tick))


def _tick(value: float, _: int | None) -> str:
    return notation.short(value)


def _key(sheet: Figure, axes: Axes, curves: list[Drawn], labels: list[str]) -> None:
    """The key beside the axes; written by hand because matplotlib's legend takes a third of the drawing time."""
    box = axes.get_position()
    pitch = min(KEY_PITCH, (box.height + 0.5 * BOTTOM) / max(len(labels), 1))
    x = [KEY_LEFT, KEY_LEFT + 0.5 * KEY_SAMPLE, KEY_LEFT + KEY_SAMPLE]
    for place, (drawn, label) in enumerate(zip(curves, labels, strict=True)):
        y = box.y1 - (place + 0.5) * pitch
        sample = Line2D(x, [y, y, y], transform=sheet.transFigure, markevery=[1], **_stroke(drawn.source))
        sheet.add_artist(sample)
        sheet.text(x[-1] + 0.012, y, label, fontsize=KEY_POINTS, verticalalignment="center_baseline")
