"""Draws the trend of a measure over recorded baselines: means with one standard error, one line per source."""

# pyright: reportUnknownMemberType=false
# matplotlib leaves the keywords of its methods untyped.

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from cross_check.compare.changes import Trend
from cross_check.report import notation
from cross_check.report.figures import Drawing, Figured, save
from cross_check.report.palette import look, rank

SIZE = (6.9, 2.9)  # inches
AXES = (0.115, 0.2, 0.62, 0.76)  # of the figure: left, bottom, width, height
SPREAD = 0.3  # of the distance of two baselines, over which the sources are set side by side
MOST_LABELS = 6


def drawings(trends: Sequence[Trend], folder: Path, pdf: bool = True) -> list[Drawing]:
    """What draws every trend into `folder` as svg and, if asked, pdf."""
    return [partial(_draw, trend, folder, pdf) for trend in trends]


def _draw(trend: Trend, folder: Path, pdf: bool) -> Figured:
    scene = f"{trend.case}/{trend.variant}"
    title = f"Trend of {trend.measure.name}"
    stem = folder / notation.slug(f"{scene} {title}")
    svg = save(lambda: _lay_out(trend), stem, title, pdf)
    return Figured(scene, title, stem.name, svg, False, [], pdf)


def _lay_out(trend: Trend) -> Figure:
    sheet = Figure(figsize=SIZE)
    axes = sheet.add_axes(AXES)
    sources = sorted(trend.points, key=rank)
    offsets = np.linspace(-0.5 * SPREAD, 0.5 * SPREAD, len(sources)) if len(sources) > 1 else np.zeros(1)
    for source, offset in zip(sources, offsets, strict=True):
        points = trend.points[source]
        style = look(source)
        axes.errorbar(
            np.arange(len(points)) + offset,
            [np.nan if point is None else point.mean for point in points],
            yerr=[
                np.nan if point is None or point.standard_error is None else point.standard_error for point in points
            ],
            color=style.color,
            linestyle=style.dash,
            linewidth=0.8,
            elinewidth=0.8,
            capsize=2.0,
            marker=style.marker,
            markerfacecolor="none",
            label=source,
        )
    every = -(-len(trend.baselines) // MOST_LABELS)
    ticks = range(0, len(trend.baselines), every)
    axes.set_xticks(list(ticks), [trend.baselines[place].replace(" ", "\n", 1) for place in ticks])
    axes.set_xlim(-0.5, len(trend.baselines) - 0.5)
    unit = "" if trend.measure.unit == "-" else f" [{trend.measure.unit}]"
    axes.set_ylabel(f"{trend.measure.observable}{unit}")
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False, borderaxespad=0.0)
    return sheet
