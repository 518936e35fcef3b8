"""Panels of the study's figures: curves with the spread over the seeds, in the style of the report."""

# pyright: reportUnknownMemberType=false
# matplotlib leaves the keywords of its methods untyped.

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from cross_check.record import Array
from cross_check.report import notation
from cross_check.report.palette import DASH_DOT, DASHED, DOTTED, LIGHT, SOLID, Dash
from cross_check.sintering.plan import TIMES

# Colour, dash and marker of each sintering time, the same in every figure.
_LOOKS: dict[float, tuple[str, Dash, str]] = {
    1e-4: (LIGHT["reference"], DOTTED, "x"),
    0.01: (LIGHT["other-2"], DASHED, "v"),
    0.02: (LIGHT["yade"], DASH_DOT, "^"),
    0.05: (LIGHT["other-1"], SOLID, "P"),
    0.2: (LIGHT["lammps"], DASHED, "D"),
    1.0: (LIGHT["liggghts"], SOLID, "o"),
}
WIDTH, PANEL, MARGIN = 6.9, 2.35, 0.65  # inches
MARKS = 8


@dataclass(frozen=True)
class Line:
    """A curve `y` over `x`, shape (P,), and the half-width of its band, the standard deviation over the seeds."""

    label: str
    x: Array
    y: Array
    band: Array | None = None
    color: str = LIGHT["native"]
    dash: Dash = SOLID
    marker: str = ""
    points: bool = False


@dataclass(frozen=True)
class Panel:
    """One set of axes. Labels carry their unit."""

    title: str
    x_label: str
    y_label: str
    lines: list[Line]
    log_x: bool = False
    log_y: bool = False
    x_limits: tuple[float, float] | None = None
    y_limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class Sheet:
    """A figure: its panels below each other, or how it is laid out where it has none."""

    name: str
    title: str
    panels: list[Panel] = field(default_factory=list[Panel])
    notes: list[str] = field(default_factory=list[str])
    lay_out: Callable[[], Figure] | None = None

    def figure(self) -> Figure:
        """The figure, not yet written."""
        return self.lay_out() if self.lay_out is not None else stacked(self.panels)


def look(time: float) -> tuple[str, Dash, str]:
    """Colour, dash and marker of a sintering time [s]."""
    return _LOOKS[time]


def timed(time: float, x: Array, curves: Sequence[Array], *, points: bool = False) -> Line:
    """The mean of the curves of all seeds, with their spread, in the look of a sintering time."""
    color, dash, marker = look(time)
    y, band = mean_and_spread(curves)
    return Line(f"t_s = {TIMES[time]} s", x, y, band, color, dash, marker, points)


def mean_and_spread(curves: Sequence[Array]) -> tuple[Array, Array | None]:
    """Mean over the seeds, and the standard deviation where there is more than one."""
    stacked_curves = np.stack(list(curves))
    spread = np.std(stacked_curves, axis=0, ddof=1) if len(curves) > 1 else None
    return np.mean(stacked_curves, axis=0), spread


def stacked(panels: list[Panel]) -> Figure:
    """Panels below each other, each with its key at the right."""
    height = PANEL * len(panels) + MARGIN
    sheet = Figure(figsize=(WIDTH, height))
    for place, panel in enumerate(panels):
        bottom = 1.0 - (PANEL * (place + 1) - 0.15) / height
        axes = sheet.add_axes((0.1, bottom, 0.66, (PANEL - 0.75) / height))
        draw(axes, panel)
    return sheet


def draw(axes: Axes, panel: Panel) -> None:
    """One panel."""
    if panel.log_x:
        axes.set_xscale("log")
    if panel.log_y:
        axes.set_yscale("log")
    for line in panel.lines:
        _draw(axes, _positive(line) if panel.log_y else line)
    axes.set_title(panel.title, loc="left", fontsize=8)
    axes.set_xlabel(panel.x_label)
    axes.set_ylabel(panel.y_label)
    if panel.x_limits is not None:
        axes.set_xlim(*panel.x_limits)
    if panel.y_limits is not None:
        axes.set_ylim(*panel.y_limits)
    for axis, log in ((axes.xaxis, panel.log_x), (axes.yaxis, panel.log_y)):
        if log:
            axis.set_major_locator(LogLocator(numticks=7))
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter(FuncFormatter(_tick))
    if any(line.label for line in panel.lines):
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), fontsize=7, frameon=False, handlelength=3)


def _tick(value: float, _: int | None) -> str:
    return notation.short(value)


def _positive(line: Line) -> Line:
    """What a log axis can show of a curve; its band ends a decade below it at most."""
    y = np.where(line.y > 0.0, line.y, np.nan)
    return replace(line, y=y, band=None if line.band is None else np.minimum(line.band, 0.9 * y))


def _draw(axes: Axes, line: Line) -> None:
    marks = 1 if line.points else max(len(line.x) // MARKS, 1)
    axes.plot(
        line.x, line.y, label=line.label or "_", color=line.color, linestyle=line.dash, linewidth=1.1,
        marker=line.marker, markevery=marks, markerfacecolor="none",
    )  # fmt: skip
    if line.band is None:
        return
    if line.points:
        axes.errorbar(line.x, line.y, yerr=line.band, fmt="none", ecolor=line.color, elinewidth=0.8, capsize=2)
    else:
        axes.fill_between(line.x, line.y - line.band, line.y + line.band, color=line.color, alpha=0.18, linewidth=0)
