"""What a campaign hands to the report: verdicts, curves, provenance and translations, all computed before."""

from __future__ import annotations

from dataclasses import dataclass, field

from cross_check.adapters.interface import Row
from cross_check.compare.changes import BaselineChanges, Trend
from cross_check.compare.verdicts import Comparison
from cross_check.record import Array


@dataclass(frozen=True)
class Curve:
    """Values `y` over `x`, both of shape (P,), of one source; the units are those of the figure.

    A difference is named by its two sources: `liggghts - native[liggghts]`.
    """

    source: str
    x: Array
    y: Array
    recorded: bool = False


@dataclass(frozen=True)
class CurveSet:
    """The curves of one scene and, below them, their differences.

    `case` is the scene (`case/variant`). A difference is drawn as its absolute value divided by `residual_scale`
    [unit of y]; a scale of 1 draws it as it is. `residual_label` names the drawn quantity.
    """

    case: str
    title: str
    x_label: str
    x_unit: str
    y_label: str
    y_unit: str
    curves: list[Curve]
    residuals: list[Curve]
    residual_scale: float
    residual_label: str


@dataclass(frozen=True)
class SweepPlot:
    """A scalar over a swept parameter for all sources, the reference among them, and the differences below.

    `case` is the case. Labels carry their unit; differences are drawn as absolute values as they are.
    """

    case: str
    title: str
    x_label: str
    y_label: str
    points: list[Curve]
    residuals: list[Curve]


@dataclass(frozen=True)
class SourceRun:
    """Where one source of one scene comes from. `wall_time` [s], `time_step` [s], `steps` [-].

    `origin` is `live`, `cache`, `recorded` or `not run`; `scene` is `case/variant`.
    """

    scene: str
    source: str
    code: str
    version: str
    package: str
    origin: str
    deck_hash: str
    machine: str
    wall_time: float
    steps: int
    time_step: float
    note: str = ""


@dataclass(frozen=True)
class CaseInfo:
    """What a case asks; `level` is its rung on the ladder of agreement and `source` the literature it follows."""

    name: str
    question: str
    level: str
    source: str
    observables: list[str]


@dataclass(frozen=True)
class Campaign:
    """One run of a suite. `duration` [s]; `started` is a date and time as text.

    `translations` has the key `scene|code` and holds the deck text (or the name of its main file) and its rows.
    `known_differences` explains every id that a verdict `known-difference(id)` may carry. `changes` are those since a
    recorded baseline, `trends` run over all recorded baselines.
    """

    suite: str
    started: str
    duration: float
    comparisons: list[Comparison]
    cases: list[CaseInfo]
    runs: list[SourceRun] = field(default_factory=list[SourceRun])
    translations: dict[str, tuple[str, list[Row]]] = field(default_factory=dict[str, tuple[str, list[Row]]])
    curves: list[CurveSet] = field(default_factory=list[CurveSet])
    sweeps: list[SweepPlot] = field(default_factory=list[SweepPlot])
    environment: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    left_out: list[str] = field(default_factory=list[str])
    known_differences: dict[str, str] = field(default_factory=dict[str, str])
    changes: list[BaselineChanges] = field(default_factory=list[BaselineChanges])
    trends: list[Trend] = field(default_factory=list[Trend])


def case_of(scene: str) -> str:
    """The case of a scene `case/variant`."""
    return scene.partition("/")[0]


def variant_of(scene: str) -> str:
    """The variant of a scene `case/variant`; the whole name where there is none."""
    return scene.partition("/")[2] or scene
