"""Pictures of samples (figures 20 to 22): disks by stress, contacts by the sign of the force, friction as dots."""

# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# matplotlib leaves the keywords of its methods untyped.

from __future__ import annotations

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from cross_check.record import Array
from cross_check.report.palette import INK, LIGHT
from cross_check.sintering import plan
from cross_check.sintering.course_figures import largest
from cross_check.sintering.measures import SHOWN
from cross_check.sintering.outcome import Arrays
from cross_check.sintering.plots import WIDTH, Sheet
from cross_check.sintering.study import NotPlanned, Sample, Study

ATTRACTIVE, REPULSIVE = LIGHT["native"], LIGHT["liggghts"]
MAP = "viridis"
# The colours reach over these quantiles of the stress of all particles of a figure.
QUANTILES = (0.05, 0.95)
LARGEST_DOT = 14.0  # points^2
BAR = 5e-3  # [m]
COLUMNS = 3


@dataclass(frozen=True)
class Picture:
    """A state to draw: arrays as measured (`position`, `radius`, `stress`, `pair`, `force`, `friction`, `box`)."""

    title: str
    arrays: Arrays
    walls: bool


def figures(study: Study) -> list[Sheet]:
    """Figures 20 to 22, of the first seed, with the sintering times that ran."""
    size = largest(study)
    sheets = [_compression(study, size)]
    for name, pressure, times in (("figure-21", 10, (1e-4, 0.02, 1.0)), ("figure-22", 100, (1e-4, 0.01, 1.0))):
        sheets.append(_vibration(study, size, name, pressure, times))
    return sheets


def _compression(study: Study, size: int) -> Sheet:
    sample = Sample(10, size)
    seed = _first(study.seeds(plan.FAST, sample), sample)
    arrays = study.outcome(plan.FAST, sample, seed).arrays
    pictures = [Picture(f"t = {time:g} s", _of(arrays, f"t={time}"), walls=True) for time in SHOWN]
    title = f"Figure 20: compression, N = {size}, p = 10 N/m, t_s = 1 s, seed {seed}"
    return Sheet("figure-20", title, notes=[_KEY], lay_out=lambda: lay_out(pictures))


def _vibration(study: Study, size: int, name: str, pressure: int, times: tuple[float, ...]) -> Sheet:
    pictures: list[Picture] = []
    seed = _first(study.seeds(plan.VIBRATION, Sample(pressure, size)), Sample(pressure, size))
    for time in times:
        try:
            arrays = study.outcome(plan.VIBRATION, Sample(pressure, size, time), seed).arrays
        except NotPlanned:
            continue
        pictures.append(Picture(f"t_s = {plan.TIMES[time]} s", _of(arrays, "end"), walls=False))
    title = f"Figure {name[-2:]}: after vibration, N = {size}, p = {pressure} N/m, seed {seed}"
    return Sheet(name, title, notes=[_KEY], lay_out=lambda: lay_out(pictures))


_KEY = (
    "Disks: mean stress, compression positive. Lines: contacts, blue where they attract and orange where they repel. "
    "Dots: size of the tangential force. Bars: 5 mm"
)


def _first(seeds: list[int], sample: Sample) -> int:
    if not seeds:
        raise NotPlanned(f"p={sample.pressure},N={sample.count}")
    return seeds[0]


def _of(arrays: Arrays, prefix: str) -> Arrays:
    """The arrays of one state by their own names."""
    return {name.removeprefix(f"{prefix} "): array for name, array in arrays.items() if name.startswith(f"{prefix} ")}


def lay_out(pictures: list[Picture]) -> Figure:
    """The pictures in rows of three, in one scale of colours and dots; each has its own bar for lengths."""
    rows = -(-len(pictures) // COLUMNS)
    sheet = Figure(figsize=(WIDTH, 2.5 * rows))
    stress = np.concatenate([picture.arrays["stress"] for picture in pictures])
    low, high = (float(np.quantile(stress, share)) for share in QUANTILES)
    scale = Normalize(low, high if high > low else low + 1.0)
    friction = np.concatenate([picture.arrays["friction"] for picture in pictures])
    largest_friction = float(np.max(friction)) if len(friction) else 1.0
    for place, picture in enumerate(pictures):
        row, column = divmod(place, COLUMNS)
        axes = sheet.add_axes((0.01 + 0.292 * column, 1.0 - (row + 0.97) / rows, 0.284, 0.88 / rows))
        _draw(axes, picture, scale, largest_friction or 1.0)
    key = sheet.add_axes((0.9, 0.12, 0.014, 0.76))
    sheet.colorbar(ScalarMappable(scale, MAP), cax=key).set_label("mean stress [N/m]")
    return sheet


def _window(arrays: Arrays) -> tuple[Array, float]:
    """Centre and half the edge of a square that holds all particles [m]."""
    low = np.min(arrays["position"] - arrays["radius"][:, None], axis=0)
    high = np.max(arrays["position"] + arrays["radius"][:, None], axis=0)
    return 0.5 * (low + high), 0.54 * float(np.max(high - low))


def _draw(axes: Axes, picture: Picture, scale: Normalize, largest_friction: float) -> None:
    arrays = picture.arrays
    position, radius, pair = arrays["position"], arrays["radius"], arrays["pair"]
    colors = mpl.colormaps[MAP](scale(arrays["stress"]))
    disks = EllipseCollection(
        2 * radius, 2 * radius, np.zeros(len(radius)), units="xy", offsets=position, transOffset=axes.transData,
        facecolors=colors, alpha=0.55, edgecolors=INK, linewidths=0.2,
    )  # fmt: skip
    axes.add_collection(disks)
    ends = position[pair]
    tones = np.where(arrays["force"] < 0.0, ATTRACTIVE, REPULSIVE)
    axes.add_collection(LineCollection(list(ends), colors=tones.tolist(), linewidths=0.7))
    first, second = pair[:, 0], pair[:, 1]
    share = (radius[first] / (radius[first] + radius[second]))[:, None]
    at = position[first] * (1.0 - share) + position[second] * share
    sizes = LARGEST_DOT * arrays["friction"] / largest_friction
    axes.scatter(at[:, 0], at[:, 1], s=sizes, color=INK, linewidths=0, zorder=3)
    if picture.walls:
        x, z, width, height = arrays["box"]
        axes.add_patch(Rectangle((x, z), width, height, fill=False, edgecolor=INK, linewidth=0.8))
    (x, z), half = _window(arrays)
    left, low = x - 0.97 * half, z - 0.99 * half
    axes.plot([left, left + BAR], [low, low], color=INK, linewidth=1.5, solid_capstyle="butt")
    axes.set_xlim(x - half, x + half)
    axes.set_ylim(z - half, z + half)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title(picture.title, fontsize=8)
