"""A made-up campaign of any size: every kind of verdict, curves with noise, decks, recorded runs. No physics."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from cross_check.adapters.interface import Row
from cross_check.compare.verdicts import AGREE, DIFFER, Comparison, Side, known_difference, not_comparable, not_run
from cross_check.record import Array
from cross_check.report.campaign import Campaign, CaseInfo, Curve, CurveSet, SourceRun, SweepPlot

CODES = ("liggghts", "yade", "lammps")
PACKAGES = {
    "liggghts": ("3.8.0", "liggghts 3.8.0+repack1-9"),
    "yade": ("2022.01a", "yade 2022.01a-14"),
    "lammps": ("29 Sep 2021", "lammps 20220106.git7586adbb6a+ds1-2"),
}
CASES = (
    ("chung-ooi-1", "Does the elastic normal impact of two identical spheres follow Hertz?"),
    ("chung-ooi-3", "Is the restitution of a sphere on a rigid wall the one that was asked, at any speed?"),
    ("normal-path", "What force does each code give along a prescribed overlap, loading and unloading?"),
    ("oblique-impact", "Do spin and rebound angle after an oblique impact agree with Maw, Barber and Fawcett?"),
    ("snapshot-column", "Are the forces in one state of many bodies the same in all codes?"),
    ("free-fall", "Does a sphere on no contact fall as Galileo says?"),
    ("two-wall-squeeze", "Is the force between two walls and a sphere the same on both sides?"),
    ("rolling-decay", "How long does a sphere roll under rolling resistance?"),
)
CUT = "yade-force-cut"
SCRIPT = "<script>alert('note')</script>"
MIRRORS = tuple(f"native[{code}]" for code in CODES)


def scene_names(count: int) -> list[str]:
    """`count` scenes spread over the cases."""
    cases = min(len(CASES), max(count // 3, 1))
    return [f"{CASES[place % cases][0]}/glass/e={0.1 * (1 + place // cases):.1f}" for place in range(count)]


def comparison(scene: str, first: str, second: str, **changes: object) -> Comparison:
    """An agreeing comparison, but for `changes`."""
    fields: dict[str, object] = {
        "case": scene,
        "level": "L1",
        "check": "peak_force",
        "quantity": "peak normal force",
        "unit": "N",
        "left": Side(first, 10.694812345678901, 2.1e-9, "time step"),
        "right": Side(second, 10.694812345678899, None),
        "discrepancy": 3.14e-14,
        "scale": "peak force",
        "bound": 1e-9,
        "bound_source": "rounding over 6000 steps",
        "verdict": AGREE,
        "expected": AGREE,
    }
    return Comparison(**(fields | changes))  # pyright: ignore[reportArgumentType]


def _comparisons(scene: str) -> list[Comparison]:
    out: list[Comparison] = []
    for source in ("native", *CODES):
        out.append(comparison(scene, source, "reference", discrepancy=4.2e-7, bound=1e-5, bound_source="dt halved"))
    for code in CODES:
        recorded = Side(code, 10.6948123, 1e-9, "rounding", recorded=code == "lammps")
        pairs = {"quantity": "force history", "check": "force_history", "right": recorded}
        out.append(comparison(scene, f"native[{code}]", code))
        out.append(comparison(scene, f"native[{code}]", code, **pairs))
        known = known_difference(CUT)
        size = {"discrepancy": 0.0213, "bound": 1e-9, "verdict": DIFFER, "expected": DIFFER}
        size |= {"verdict": known, "expected": known} if code == "yade" else {}
        out.append(comparison(scene, "native", code, **size, note="predicted by the mirror to 4e-14"))
    reason = not_comparable("LAMMPS has no switch for the cut at zero")
    absent = {"discrepancy": None, "bound": None, "verdict": reason, "expected": reason}
    out.append(comparison(scene, "liggghts", "yade", discrepancy=0.02, verdict=DIFFER, expected=DIFFER))
    out.append(comparison(scene, "yade", "lammps", **absent, left=Side("yade", None, None)))
    return out


def _noise(seed: int, size: float, points: int) -> Array:
    return np.random.default_rng(seed).normal(size=points) * size


def _curves(scene: str, seed: int, points: int) -> list[CurveSet]:
    time = np.linspace(0.0, 8.4e-6, points)
    force = 10.7 * np.sin(np.pi * time / time[-1]) ** 1.5
    overlap = 1.2e-7 * np.sin(np.pi * time / time[-1])
    sizes = {"liggghts": 0.98, "yade": 1.015, "lammps": 1.0}
    values = {"native": force, "reference": force * (1 + 1e-6)}
    for code, size in sizes.items():
        values[f"native[{code}]"] = force * size
        values[code] = force * size + _noise(seed, 1e-13, points)
    out: list[CurveSet] = []
    for x, label, unit in ((time, "time", "s"), (overlap, "overlap", "m")):
        curves = [Curve(name, x, y, recorded=name == "lammps") for name, y in values.items()]
        pairs = [(code, f"native[{code}]") for code in CODES] + [(code, "native") for code in CODES]
        residuals = [Curve(f"{a} - {b}", x, values[a] - values[b]) for a, b in [*pairs, ("native", "reference")]]
        title = f"Normal force over {label}"
        label_below = "|diff.| / peak force"
        out.append(
            CurveSet(scene, title, label, unit, "normal force", "N", curves, residuals, float(force.max()), label_below)
        )
    return out


def _sweep(case: str) -> SweepPlot:
    x = np.linspace(0.1, 1.0, 10)
    exact = x * 0.97
    points = [Curve("reference", np.linspace(0.1, 1.0, 100), np.linspace(0.1, 1.0, 100) * 0.97)]
    points += [Curve(name, x, exact) for name in ("native", *CODES)]
    residuals = [Curve(f"{name} - reference", x, _noise(len(name), 1e-8, 10)) for name in ("native", *CODES)]
    return SweepPlot(case, "Restitution asked and got", "restitution asked [-]", "restitution [-]", points, residuals)


def _deck(scene: str, code: str, lines: int) -> tuple[str, list[Row]]:
    rows = [
        Row("pairs.0-1.damping_ratio", "0.070", "coefficientRestitution", "0.80000000000000004", "-", "exp(-pi b / w)"),
        Row("materials.glass.young", "4.8e10", "youngsModulus", "48000000000", "Pa", "E"),
        Row("time_step", "1.5e-9", "timestep", "1.5000000000000000e-09", "s", "dt"),
    ]
    body = "\n".join(f"fix m{line} all property/global value{line} peratomtype {line}.0" for line in range(lines))
    return f"# {code} deck of {scene}\n{body}\nrun 6000\n", rows


def _runs(scene: str) -> list[SourceRun]:
    runs: list[SourceRun] = []
    for source in ("native", *MIRRORS):
        runs.append(
            SourceRun(
                scene, source, "crossgrain", "0.1.0", "this repository", "live", "9f3a61", "box", 0.0123, 6000, 1.5e-9
            )
        )
    for code in CODES:
        version, package = PACKAGES[code]
        origin = "recorded" if code == "lammps" else "live"
        runs.append(
            SourceRun(scene, code, code, version, package, origin, f"{code[:2]}77b0c2", "box", 2.31, 6000, 1.5e-9, "")
        )
    return runs


def build(scenes: int = 6, points: int = 2000, deck_lines: int = 40) -> Campaign:
    """A campaign in which every verdict is the expected one."""
    names = scene_names(scenes)
    used = [case for case in CASES if any(name.startswith(f"{case[0]}/") for name in names)]
    cases = [CaseInfo(name, ask, "L1", "Chung and Ooi (2011), test 1", ["peak normal force"]) for name, ask in used]
    comparisons = [item for name in names for item in _comparisons(name)]
    reason = not_run("full only")
    comparisons.append(
        comparison(names[0], "native", "lammps", quantity="long run", discrepancy=None, verdict=reason, expected=reason)
    )
    return Campaign(
        suite="standard",
        started="2026-01-31 09:30:00",
        duration=133.7,
        comparisons=comparisons,
        cases=cases,
        runs=[run for name in names for run in _runs(name)],
        translations={f"{name}|{code}": _deck(name, code, deck_lines) for name in names for code in CODES},
        curves=[item for place, name in enumerate(names) for item in _curves(name, place, points)],
        sweeps=[_sweep(used[0][0])],
        environment=[("machine", "x86-64, 2 cores"), ("python", "3.11.7"), ("cargo", "1.84")],
        left_out=["sintering: seeds 2 to 8 (full only)"],
        known_differences={CUT: "YADE never cuts the normal force at zero: it pulls at the end of a damped impact."},
    )


@dataclass(frozen=True)
class Written:
    """A campaign and where its report is."""

    campaign: Campaign
    folder: Path
    page: str


def odd_campaign() -> Campaign:
    """Three verdicts that nobody expected: a difference, a NaN and a known difference without an explanation."""
    campaign = build(6, points=400)
    lines = list(campaign.comparisons)
    lines[3] = replace(lines[3], verdict=DIFFER, discrepancy=2.3e-4, note=f"log says {SCRIPT}")
    lines[5] = replace(
        lines[5],
        verdict=not_run(f"stopped \x07 {SCRIPT}"),
        left=Side("native[liggghts]", math.nan, None),
        discrepancy=math.nan,
    )
    lines[20] = replace(lines[20], verdict=known_difference("nobody-explained-this"), expected=AGREE)
    return replace(campaign, comparisons=lines, curves=campaign.curves[::2])
