"""The verdict matrix: scenes against pairs of sources, each cell the comparison that deserves the first look."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cross_check.compare.verdicts import Comparison, kind
from cross_check.report import notation
from cross_check.report.campaign import case_of, variant_of
from cross_check.report.palette import mirrored, rank

SYMBOLS = {
    "agree": "✓",
    "differ": "≠",
    "inconclusive": "?",
    "known-difference": "≈",
    "not-comparable": "∅",
    "not-run": "○",
}
SHORT_NAMES = {"known-difference": "known", "not-comparable": "not comp.", "inconclusive": "inconcl."}
SEVERITY = ("agree", "not-comparable", "known-difference", "not-run", "inconclusive", "differ")
GROUPS = (
    ("against the reference", "is it right?"),
    ("mirror against its code", "do we know what the code does?"),
    ("native against the codes", "what does the physical choice change?"),
    ("codes and predictions among each other", ""),
)
Pair = tuple[str, str]


@dataclass(frozen=True)
class Entry:
    """A comparison and the anchor under which the page shows it."""

    anchor: str
    comparison: Comparison


@dataclass(frozen=True)
class Cell:
    """One cell: the worst comparison of a scene (or case) and a pair. An empty cell has an empty kind."""

    kind: str = ""
    symbol: str = ""
    word: str = ""
    numbers: str = ""
    anchor: str = ""
    label: str = ""
    unexpected: bool = False
    recorded: bool = False
    count: int = 0


@dataclass(frozen=True)
class MatrixRow:
    """One scene: its name within the case, its cells in the order of the columns, the kinds and text to filter by."""

    name: str
    anchor: str
    cells: list[Cell]
    kinds: str
    text: str


@dataclass(frozen=True)
class MatrixGroup:
    """One case: the worst of its scenes per column, and the scenes."""

    name: str
    anchor: str
    cells: list[Cell]
    rows: list[MatrixRow]
    unexpected: int


@dataclass(frozen=True)
class ColumnGroup:
    """Neighbouring columns that answer the same question; `width` is their number."""

    name: str
    question: str
    width: int


@dataclass(frozen=True)
class Matrix:
    """The whole matrix; `columns` are pairs of sources."""

    column_groups: list[ColumnGroup]
    columns: list[Pair]
    starts: list[bool]
    groups: list[MatrixGroup]


def severity(comparison: Comparison) -> tuple[bool, int, float]:
    """What sorts a comparison: unexpected first, then the kind of its verdict, then how near its bound it is."""
    name = kind(comparison.verdict)
    rung = SEVERITY.index(name) if name in SEVERITY else len(SEVERITY)
    return (not comparison.as_expected, rung, _fullness(comparison))


def _fullness(comparison: Comparison) -> float:
    discrepancy, bound = comparison.discrepancy, comparison.bound
    if discrepancy is None:
        return -1.0
    if not math.isfinite(discrepancy):
        return math.inf
    return abs(discrepancy) / bound if bound else abs(discrepancy)


def pair_of(comparison: Comparison) -> Pair:
    """The two sources of a comparison."""
    return (comparison.left.source, comparison.right.source)


def group_of(pair: Pair) -> int:
    """Which question, an index into GROUPS, a pair of sources answers."""
    left, right = pair
    if "reference" in pair or "closed form" in pair:
        return 0
    if mirrored(left) == right or mirrored(right) == left:
        return 1
    return 2 if "native" in pair and not (mirrored(left) or mirrored(right)) else 3


def build(entries: list[Entry]) -> Matrix:
    """The matrix of all comparisons, cases and scenes in the order of their first comparison."""
    pairs = {pair_of(entry.comparison) for entry in entries}
    columns = sorted(pairs, key=lambda pair: (group_of(pair), *map(rank, pair)))
    cases: dict[str, dict[str, list[Entry]]] = {}
    for entry in entries:
        scene = entry.comparison.case
        cases.setdefault(case_of(scene), {}).setdefault(scene, []).append(entry)
    numbers = [group_of(pair) for pair in columns]
    groups = [ColumnGroup(*GROUPS[which], numbers.count(which)) for which in sorted(set(numbers))]
    starts = [place == 0 or numbers[place - 1] != which for place, which in enumerate(numbers)]
    return Matrix(groups, columns, starts, [_group(case, scenes, columns) for case, scenes in cases.items()])


def _group(case: str, scenes: dict[str, list[Entry]], columns: list[Pair]) -> MatrixGroup:
    together = [entry for entries in scenes.values() for entry in entries]
    rows = [_row(scene, entries, columns) for scene, entries in scenes.items()]
    unexpected = sum(not entry.comparison.as_expected for entry in together)
    return MatrixGroup(case, f"case-{notation.slug(case)}", _cells(together, columns), rows, unexpected)


def _row(scene: str, entries: list[Entry], columns: list[Pair]) -> MatrixRow:
    comparisons = [entry.comparison for entry in entries]
    words = [scene, *sorted({item.quantity for item in comparisons}), *sorted({item.verdict for item in comparisons})]
    kinds = {kind(item.verdict) for item in comparisons}
    if not all(item.as_expected for item in comparisons):
        kinds.add("unexpected")
    return MatrixRow(
        name=variant_of(scene),
        anchor=f"scene-{notation.slug(scene)}",
        cells=_cells(entries, columns),
        kinds=" ".join(sorted(kinds)),
        text=" ".join(words).lower(),
    )


def _cells(entries: list[Entry], columns: list[Pair]) -> list[Cell]:
    by_pair: dict[Pair, list[Entry]] = {}
    for entry in entries:
        by_pair.setdefault(pair_of(entry.comparison), []).append(entry)
    return [_cell(by_pair[pair]) if pair in by_pair else Cell() for pair in columns]


def _cell(entries: list[Entry]) -> Cell:
    first = max(entries, key=lambda entry: severity(entry.comparison))
    worst = first.comparison
    name = kind(worst.verdict)
    numbers = ""
    if worst.discrepancy is not None:
        numbers = f"{notation.short(worst.discrepancy)} / {notation.short(worst.bound)}"
    left, right = pair_of(worst)
    expectation = "as expected" if worst.as_expected else f"NOT as expected ({worst.expected})"
    label = f"{worst.case}, {worst.quantity}, {left} vs {right}: {worst.verdict}, {expectation}"
    sides = [side for entry in entries for side in (entry.comparison.left, entry.comparison.right)]
    return Cell(
        kind=name,
        symbol=SYMBOLS.get(name, "!"),
        word=SHORT_NAMES.get(name, name),
        numbers=numbers,
        anchor=first.anchor,
        label=label + (f"; discrepancy / bound = {numbers}" if numbers else ""),
        unexpected=not worst.as_expected,
        recorded=any(side.recorded for side in sides),
        count=len(entries),
    )
