"""What changed between two baselines of a case, and the trend over many.

Two ensembles whose values differ are held against their scatter: Welch's two-sided test of equal means. A comparison of
baselines makes many such tests, and one in twenty of them would cry wolf; the p values of one comparison are therefore
adjusted so that the expected share of false ones among the changes it reports stays below LEVEL.
Source: Y. Benjamini, Y. Hochberg, J. R. Stat. Soc. B 57 (1995) 289-300.

"Within scatter" is no proof of sameness: the interval of the difference says how large a change may hide in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from cross_check.baseline import Baseline, BaselineError, Entry, Measure
from cross_check.compare.quantity import Undefined
from cross_check.compare.samples import Sample, sample, welch
from cross_check.record import Array

LEVEL = 0.05
IDENTICAL = "identical"
WITHIN = "changed within scatter"
BEYOND = "changed beyond scatter"
UNJUDGED = "changed, no scatter to judge by"
NEW = "new"
GONE = "gone"
KINDS = (BEYOND, UNJUDGED, GONE, NEW, WITHIN, IDENTICAL)


@dataclass(frozen=True)
class Change:
    """What became of one measure of one source of one variant.

    `old` and `new` are None where there is none, or where an ensemble of one has no scatter; `values` has both means.
    `interval` is that of new - old at 95 %. `p` is Welch's p value, adjusted for the number of tests. `notes` tell what
    else is different: seeds, decks, other measured numbers of these runs, versions, machines.
    """

    kind: str
    variant: str
    source: str
    measure: Measure
    values: tuple[float | None, float | None]
    sizes: tuple[int, int]
    old: Sample | None = None
    new: Sample | None = None
    interval: tuple[float, float] | None = None
    p: float | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class VersionChange:
    """A program of which the two baselines used different versions: `old` and `new` list them."""

    name: str
    old: str
    new: str


@dataclass(frozen=True)
class BaselineChanges:
    """All changes from the baseline `old` to the baseline `new` of a case, the most telling first."""

    case: str
    old: str
    new: str
    changes: list[Change]
    versions: list[VersionChange] = field(default_factory=list[VersionChange])

    def count(self, kind: str) -> int:
        """How many changes are of a kind."""
        return sum(change.kind == kind for change in self.changes)


def compare_baselines(old: Baseline, new: Baseline) -> BaselineChanges:
    """What changed from `old` to `new`. Raises BaselineError for baselines of different cases."""
    if old.case != new.case:
        raise BaselineError(
            f"baselines of different cases: {old.case} ({old.name}) and {new.case} ({new.name}); "
            "only those of one case can be compared"
        )
    befores = {(entry.variant, entry.source): entry for entry in old.entries}
    afters = {(entry.variant, entry.source): entry for entry in new.entries}
    changes: list[Change] = []
    for key in sorted(befores.keys() | afters.keys()):
        for measure in dict.fromkeys((*new.measures, *old.measures)):
            before = _column(old, befores.get(key), measure)
            after = _column(new, afters.get(key), measure)
            if before is not None or after is not None:
                changes.append(_change(key, measure, before, after, befores.get(key), afters.get(key)))
    changes = sorted(
        _adjusted(changes), key=lambda change: (KINDS.index(change.kind), 1.0 if change.p is None else change.p)
    )
    return BaselineChanges(new.case, old.name, new.name, changes, _versions(old, new))


def _column(baseline: Baseline, entry: Entry | None, measure: Measure) -> Array | None:
    """The values of a measure, shape (n,), or None where the baseline does not have it."""
    if entry is None or measure not in baseline.measures:
        return None
    place = baseline.measures.index(measure)
    return np.array([member.values[place] for member in entry.members])


def _change(
    key: tuple[str, str],
    measure: Measure,
    before: Array | None,
    after: Array | None,
    old: Entry | None,
    new: Entry | None,
) -> Change:
    """One change; the kind of one that a test must judge is still open and stands as WITHIN."""
    means = tuple(None if column is None else float(np.mean(column)) for column in (before, after))
    sizes = tuple(0 if column is None else len(column) for column in (before, after))
    found = Change(WITHIN, *key, measure, (means[0], means[1]), (sizes[0], sizes[1]))
    if before is None or after is None or old is None or new is None:
        return replace(found, kind=NEW if before is None else GONE)
    found = replace(found, notes=_notes(old, new))
    samples: list[Sample | None] = []
    for column in (before, after):
        try:
            samples.append(sample(column, f"{key[1]} of {key[0]}, {measure.name}"))
        except Undefined:
            samples.append(None)
    found = replace(found, old=samples[0], new=samples[1])
    if np.array_equal(before, after) and _seeds(old) == _seeds(new):
        return replace(found, kind=IDENTICAL)
    if samples[0] is None or samples[1] is None:
        return replace(found, kind=UNJUDGED)
    test = welch(samples[1], samples[0])
    return replace(found, interval=test.interval(1.0 - LEVEL), p=test.p_changed())


def _adjusted(changes: list[Change]) -> list[Change]:
    """The changes with their p values adjusted for each other, and their kinds."""
    raw = [change.p for change in changes if change.p is not None]
    if not raw:
        return changes
    # It takes a second to import, which every command would wait for.
    from scipy.stats import false_discovery_control  # pyright: ignore[reportUnknownVariableType]  # untyped

    adjusted = iter(false_discovery_control(raw))
    found: list[Change] = []
    for change in changes:
        if change.p is None:
            found.append(change)
            continue
        p = float(next(adjusted))
        found.append(replace(change, p=p, kind=BEYOND if p < LEVEL else WITHIN))
    return found


def _seeds(entry: Entry) -> list[int]:
    return [member.seed for member in entry.members]


def _notes(old: Entry, new: Entry) -> tuple[str, ...]:
    """What else is different between two recorded ensembles of one source."""
    notes: list[str] = []
    if _seeds(old) != _seeds(new):
        notes.append(f"seeds {_seeds(old)} became {_seeds(new)}")
    pairs = [(one, other) for one in old.members for other in new.members if one.seed == other.seed]
    decks = sum(one.deck_hash != other.deck_hash for one, other in pairs)
    if decks:
        notes.append(f"{decks} of {len(pairs)} decks changed: the question is another one")
    bits = sum(one.digest != other.digest for one, other in pairs)
    if bits:
        notes.append(f"{bits} of {len(pairs)} measured records changed")
    if (old.code.version, old.code.package) != (new.code.version, new.code.package):
        notes.append(f"{old.code.name} {old.code.version} became {new.code.name} {new.code.version}")
    machines = [sorted({member.machine for member in entry.members}) for entry in (old, new)]
    if machines[0] != machines[1]:
        notes.append(f"machine {'; '.join(machines[0])} became {'; '.join(machines[1])}")
    return tuple(notes)


def _versions(old: Baseline, new: Baseline) -> list[VersionChange]:
    def used(baseline: Baseline) -> dict[str, str]:
        found: dict[str, set[str]] = {"crossgrain": {baseline.version}}
        for entry in baseline.entries:
            found.setdefault(entry.code.name, set()).add(f"{entry.code.version} ({entry.code.package})")
        return {name: ", ".join(sorted(versions)) for name, versions in found.items()}

    before, after = used(old), used(new)
    names = sorted(name for name in before.keys() & after.keys() if before[name] != after[name])
    return [VersionChange(name, before[name], after[name]) for name in names]


@dataclass(frozen=True)
class TrendPoint:
    """One baseline of a trend: mean and standard error in the unit of the measure, None for an ensemble of one."""

    date: str
    version: str
    mean: float
    standard_error: float | None
    size: int


@dataclass(frozen=True)
class Trend:
    """A measure of one variant over baselines, for each source the points in the order of time."""

    case: str
    variant: str
    measure: Measure
    baselines: list[str]
    points: dict[str, list[TrendPoint | None]]


def trends(baselines: Sequence[Baseline]) -> list[Trend]:
    """The trend of every measure of every variant over baselines of one case; None stands where a source is missing.

    Raises BaselineError for baselines of different cases.
    """
    cases = sorted({baseline.case for baseline in baselines})
    if len(cases) > 1:
        raise BaselineError(f"baselines of different cases: {', '.join(cases)}; a trend is of one case")
    ordered = sorted(baselines, key=lambda baseline: (baseline.date, baseline.version))
    variants = sorted({entry.variant for baseline in ordered for entry in baseline.entries})
    measures = dict.fromkeys(measure for baseline in ordered for measure in baseline.measures)
    names = [baseline.name for baseline in ordered]
    found = [
        Trend(cases[0], variant, measure, names, _points(ordered, variant, measure))
        for variant in variants
        for measure in measures
    ]
    return [trend for trend in found if trend.points]


def _points(baselines: Sequence[Baseline], variant: str, measure: Measure) -> dict[str, list[TrendPoint | None]]:
    sources = sorted({entry.source for baseline in baselines for entry in baseline.entries if entry.variant == variant})
    lines: dict[str, list[TrendPoint | None]] = {}
    for source in sources:
        line: list[TrendPoint | None] = []
        for baseline in baselines:
            entries = [entry for entry in baseline.entries if (entry.variant, entry.source) == (variant, source)]
            column = _column(baseline, entries[0] if entries else None, measure)
            line.append(None if column is None else _point(baseline, column))
        if any(point is not None for point in line):
            lines[source] = line
    return lines


def _point(baseline: Baseline, column: Array) -> TrendPoint:
    try:
        error = sample(column, baseline.name).standard_error
    except Undefined:
        error = None
    return TrendPoint(baseline.date, baseline.version, float(np.mean(column)), error, len(column))
