"""Figures of the law by itself: one contact (figures 3 and 5) and the softening of its stiffness (figure 6)."""

from __future__ import annotations

import numpy as np

from cross_check.report.palette import DASHED, LIGHT, SOLID
from cross_check.sintering.law import Law, contact, softening
from cross_check.sintering.plots import Line, Panel, Sheet
from cross_check.sintering.study import Study

POINTS = 200
# Largest overlaps of the loops of figure 3, as shares of the fluid overlap.
LOOPS = (0.5, 1.0, 2.0, 3.0)
# Softened stiffness of figure 5, as a share of the cold one.
SOFTENED = 0.2
COLORS = (LIGHT["reference"], LIGHT["other-2"], LIGHT["yade"], LIGHT["liggghts"])
# Figure 6: from 20 to 118 C with t0 = 10 s [K, s].
STEP = (293.15, 391.15)
RELAXATION = 10.0
LONGEST = 1e3


def figures(study: Study) -> list[Sheet]:
    """Figures 3, 5 and 6."""
    return [_loops(study.law), _cycle(study.law), _softening(study.law)]


def _loops(law: Law) -> Sheet:
    """Loading to several overlaps, unloading to none, and back."""
    scale = float(law["fluid_overlap"])
    lines: list[Line] = []
    for share, color in zip(LOOPS, COLORS, strict=True):
        up = np.linspace(0.0, share * scale, POINTS)
        path = np.concatenate([up, up[::-1], up])
        found = contact(law, path, np.full(len(path), float(law["k1"])))
        lines.append(Line(f"loaded to {share:g}", path / scale, found["force"], color=color))
    axes = ("overlap / fluid overlap [-]", "normal force [N]")
    return Sheet("figure-03", "Figure 3: force law with varying stiffness", [Panel("cold contact", *axes, lines)])


def _cycle(law: Law) -> Sheet:
    """Loops before heating, hot, and after cooling: the contact is loaded cold, k1 falls and rises at rest."""
    cold, scale = float(law["k1"]), float(law["fluid_overlap"])
    load = np.linspace(0.0, scale, POINTS)
    rest = np.full(POINTS, scale)
    soft = np.linspace(cold, SOFTENED * cold, POINTS)
    loop = np.concatenate([np.linspace(scale, 0.2 * scale, POINTS), np.linspace(0.2 * scale, scale, POINTS)])
    steady = np.full(len(loop), 1.0)
    stories = {
        "cold": (np.concatenate([load, loop]), np.concatenate([np.full(POINTS, cold), cold * steady])),
        "hot": (
            np.concatenate([load, rest, loop]),
            np.concatenate([np.full(POINTS, cold), soft, SOFTENED * cold * steady]),
        ),
        "cooled": (
            np.concatenate([load, rest, rest, loop]),
            np.concatenate([np.full(POINTS, cold), soft, soft[::-1], cold * steady]),
        ),
    }
    looks = {"cold": (LIGHT["native"], SOLID), "hot": (LIGHT["liggghts"], DASHED), "cooled": (LIGHT["yade"], SOLID)}
    curves: dict[str, Line] = {}
    for name, (path, stiffness) in stories.items():
        found = contact(law, path, stiffness)
        color, dash = looks[name]
        last = slice(-len(loop), None)
        curves[name] = Line(name, path[last] / scale, found["force"][last], color=color, dash=dash)
    axes = ("overlap / fluid overlap [-]", "normal force [N]")
    panels = [
        Panel("heating: k1 falls, the largest overlap stays", *axes, [curves["cold"], curves["hot"]]),
        Panel("cooling: k1 rises again", *axes, [curves["hot"], curves["cooled"]]),
    ]
    note = f"k1 falls to {SOFTENED:g} of its cold value and returns while the overlap is held; then a loop is driven"
    return Sheet("figure-05", "Figure 5: force laws for varying stiffness k1", panels, [note])


def _softening(law: Law) -> Sheet:
    """k1(T,t) after a step of the temperature."""
    times = np.concatenate([[0.0], np.geomspace(1e-2, LONGEST, POINTS)])
    hot = np.full(len(times), STEP[1])
    hot[0] = STEP[0]
    relaxation = np.full(len(times), RELAXATION)
    share = softening(law, times, hot, relaxation) / float(law["k1"])
    label = "k1(T,t) / k1 [-]"
    lines = [Line("", times, share)]
    panels = [
        Panel("linear time", "time [s]", label, lines, x_limits=(0.0, 100.0)),
        Panel("logarithmic time", "time [s]", label, [Line("", times[1:], share[1:])], log_x=True),
    ]
    return Sheet("figure-06", "Figure 6: stiffness k1 after a step from 20 to 118 \N{DEGREE SIGN}C, t0 = 10 s", panels)
