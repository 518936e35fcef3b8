"""What the section *what changed since the baseline* shows, as text ready to print."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cross_check.compare.changes import (
    BEYOND,
    GONE,
    IDENTICAL,
    KINDS,
    NEW,
    UNJUDGED,
    WITHIN,
    BaselineChanges,
    Change,
    VersionChange,
)
from cross_check.compare.samples import Sample
from cross_check.report import notation

# Symbol, and the kind of verdict whose colours a kind of change has.
LOOKS = {
    BEYOND: ("≠", "differ"),
    UNJUDGED: ("?", "inconclusive"),
    GONE: ("\N{MINUS SIGN}", "not-run"),
    NEW: ("+", "not-run"),
    WITHIN: ("≈", "known-difference"),
    IDENTICAL: ("✓", "agree"),
}


@dataclass(frozen=True)
class ChangeLine:
    """One change in words."""

    variant: str
    source: str
    measure: str
    unit: str
    old: str
    new: str
    difference: str
    interval: str
    p: str
    kind: str
    symbol: str
    look: str
    notes: str


@dataclass(frozen=True)
class Count:
    """How many changes of a kind there are."""

    kind: str
    symbol: str
    look: str
    number: int


@dataclass(frozen=True)
class ChangesView:
    """All changes of one case in words."""

    case: str
    anchor: str
    old: str
    new: str
    counts: list[Count]
    versions: list[VersionChange]
    changed: list[ChangeLine]
    identical: list[ChangeLine]


def views(found: Sequence[BaselineChanges]) -> list[ChangesView]:
    """The changes of every case."""
    return [_view(item) for item in found]


def _view(item: BaselineChanges) -> ChangesView:
    counts = [Count(kind, *LOOKS[kind], item.count(kind)) for kind in KINDS if item.count(kind)]
    return ChangesView(
        case=item.case,
        anchor=f"changes-{notation.slug(item.case)}",
        old=item.old,
        new=item.new,
        counts=counts,
        versions=item.versions,
        changed=[_line(change) for change in item.changes if change.kind != IDENTICAL],
        identical=[_line(change) for change in item.changes if change.kind == IDENTICAL],
    )


def _line(change: Change) -> ChangeLine:
    before, after = change.values
    difference = None if before is None or after is None else after - before
    interval = notation.ABSENT
    if change.interval is not None:
        interval = f"{notation.number(change.interval[0], 3)} to {notation.number(change.interval[1], 3)}"
    symbol, look = LOOKS[change.kind]
    return ChangeLine(
        variant=change.variant,
        source=change.source,
        measure=change.measure.name,
        unit="" if change.measure.unit == "-" else change.measure.unit,
        old=_side(before, change.old, change.sizes[0]),
        new=_side(after, change.new, change.sizes[1]),
        difference=notation.number(difference, 3),
        interval=interval,
        p=notation.number(change.p, 2),
        kind=change.kind,
        symbol=symbol,
        look=look,
        notes="; ".join(change.notes),
    )


def _side(mean: float | None, found: Sample | None, size: int) -> str:
    if mean is None:
        return notation.ABSENT
    if found is None:
        return f"{notation.number(mean, 6)} (n {size})"
    return f"{notation.number(mean, 6)} ± {notation.number(found.standard_deviation, 2)} (n {size})"
