"""The targets: each claim of the paper, the threshold set for it, and what the runs give."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from cross_check import toml_file
from cross_check.sintering.errors import StudyError
from cross_check.sintering.plan import CONTROL_SEEDS, MODES, PLAIN
from cross_check.sintering.shapes import SHAPES, Evidence
from cross_check.sintering.study import Failed, NotPlanned, Sample, Study

TABLE = Path(__file__).with_name("targets.toml")
MET, MISSED, REPORTED, LEFT_OUT, FAILED = "met", "missed", "reported", "full only", "failed"
# Seeds on which a threshold is judged, by the number of disks.
SEEDS = {100: 3, 300: 2, 3: 3}
_OWN = ("id", "claim", "paper", "threshold", "shape", "unit", "low", "high", "strict", "quick", "each", "seeds")
_SAMPLE = ("pressures", "sizes", "time", "mode")


@dataclass(frozen=True)
class Target:
    """One claim for one kind of sample. `low` and `high` are the limits; a target without either is only reported.

    `each`: every seed has to keep the limits, not the mean. `strict`: the limits themselves do not count as kept.
    `quick`: the quick form judges it, on one seed. `seeds` is how many the full form needs.
    """

    id: str
    claim: str
    paper: str
    threshold: str
    shape: str
    unit: str
    sample: Sample
    low: float | None = None
    high: float | None = None
    strict: bool = False
    quick: bool = False
    each: bool = False
    seeds: int = 1
    asked: dict[str, Any] = field(default_factory=dict[str, Any])

    @property
    def gated(self) -> bool:
        """Whether there is a threshold."""
        return self.low is not None or self.high is not None

    @property
    def name(self) -> str:
        """`T9b-rise,p=100,N=300`: also the name of its verdict."""
        return f"{self.id},p={self.sample.pressure},N={self.sample.count}"

    def keeps(self, value: float) -> bool:
        """Whether a value lies within the limits; NaN never does."""
        if not math.isfinite(value):
            return False
        above = self.low is None or value > self.low or (value == self.low and not self.strict)
        below = self.high is None or value < self.high or (value == self.high and not self.strict)
        return above and below

    def outside(self, value: float) -> float:
        """How far a value lies outside the limits, 0 within."""
        if math.isnan(value):
            return math.nan
        below = 0.0 if self.low is None else self.low - value
        above = 0.0 if self.high is None else value - self.high
        return max(below, above, 0.0)


@dataclass(frozen=True)
class Row:
    """What became of a target. `verdict` is one of the words above; `reason` says why there is no value."""

    target: Target
    verdict: str
    evidence: Evidence | None = None
    reason: str = ""

    @property
    def spread(self) -> float | None:
        """Standard deviation over the seeds, None for fewer than two."""
        if self.evidence is None or len(self.evidence.seeds) < 2:
            return None
        return float(np.std(self.evidence.seeds, ddof=1))

    @property
    def kept_by(self) -> int:
        """How many of the seeds keep the limits by themselves."""
        return 0 if self.evidence is None else sum(self.target.keeps(value) for value in self.evidence.seeds)


def targets(path: Path = TABLE) -> list[Target]:
    """All targets of a table, one for each pressure and size. Raises StudyError."""
    try:
        entries: list[dict[str, Any]] = toml_file.read(path)["target"]
        found = [target for entry in entries for target in _expanded(entry)]
    except (toml_file.TomlError, KeyError, TypeError) as error:
        raise StudyError(f"{path}: {error}") from error
    names = [target.name for target in found]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise StudyError(f"{path}: stated twice: {', '.join(twice)}")
    return found


def _expanded(entry: dict[str, Any]) -> Iterator[Target]:
    if entry["shape"] not in SHAPES:
        raise StudyError(f"{entry['id']}: shape {entry['shape']!r} is unknown (known: {', '.join(SHAPES)})")
    mode = entry.get("mode", PLAIN)
    if mode not in MODES:
        raise StudyError(f"{entry['id']}: mode {mode!r} is unknown (known: {', '.join(MODES)})")
    own = {name: entry[name] for name in _OWN if name in entry}
    asked = {name: value for name, value in entry.items() if name not in (*_OWN, *_SAMPLE)}
    for pressure, count in itertools.product(entry["pressures"], entry["sizes"]):
        sample = Sample(int(pressure), int(count), float(entry.get("time", 1.0)), mode)
        planned = CONTROL_SEEDS if mode != PLAIN and count == 100 else SEEDS[count]
        yield Target(**(own | {"seeds": entry.get("seeds", planned)}), sample=sample, asked=asked)


def judge(target: Target, study: Study) -> Row:
    """What the study says about one target. Raises StudyError for a quantity that is not known."""
    if not study.full and not target.quick:
        return Row(target, LEFT_OUT)
    try:
        evidence = SHAPES[target.shape](study, target.sample, target.asked)
    except NotPlanned as error:
        return Row(target, LEFT_OUT if not study.full else FAILED, reason=f"no run of {error}")
    except Failed as error:
        return Row(target, FAILED, reason=str(error))
    except KeyError as error:
        raise StudyError(f"{target.name}: the key {error} is missing for the shape {target.shape}") from error
    if not target.gated:
        return Row(target, REPORTED, evidence)
    needed = target.seeds if study.full else 1
    if len(evidence.seeds) < needed:
        reason = f"{len(evidence.seeds)} seeds, the threshold is for {needed}"
        fewer = study.seeds_asked is not None and study.seeds_asked < needed
        return Row(target, LEFT_OUT if fewer else FAILED, evidence, reason)
    judged = evidence.seeds if target.each else [evidence.value]
    return Row(target, MET if all(target.keeps(value) for value in judged) else MISSED, evidence)
