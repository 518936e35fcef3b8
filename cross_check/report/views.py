"""What the page shows, as text ready to print: templates hold no arithmetic."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from cross_check.adapters.interface import Row
from cross_check.compare.verdicts import Comparison, Side, kind
from cross_check.report import notation, tables
from cross_check.report.campaign import Campaign, CaseInfo, SourceRun, case_of, variant_of
from cross_check.report.figures import Figured
from cross_check.report.matrix import SYMBOLS, Entry, severity

DECK_LETTERS = 30_000  # a longer deck is cut in the page, not in the run's folder
DECK_TAIL = 4_000
SHEET_ROWS = 300
ORIGINS = ("live", "cache", "recorded", "not run")


@dataclass(frozen=True)
class SideView:
    """One side of a comparison in words."""

    source: str
    value: str
    uncertainty: str
    bad: bool
    recorded: bool


@dataclass(frozen=True)
class Line:
    """One comparison in words; `kinds` and `text` serve the filter."""

    anchor: str
    scene: str
    scene_anchor: str
    quantity: str
    check: str
    unit: str
    left: SideView
    right: SideView
    discrepancy: str
    scale: str
    bound: str
    bound_source: str
    kind: str
    reason: str
    symbol: str
    expected: str
    unexpected: bool
    bad: bool
    note: str
    kinds: str
    text: str


@dataclass(frozen=True)
class Sheet:
    """The translation of one scene into one code; `same_as` is the anchor of an equal deck shown before."""

    anchor: str
    code: str
    rows: list[Row]
    rows_left_out: int
    text: str
    letters_left_out: int
    same_as: str


@dataclass(frozen=True)
class RunView:
    """Provenance of one source in words."""

    run: SourceRun
    wall_time: str
    time_step: str
    origin_class: str


@dataclass(frozen=True)
class SceneView:
    """One scene with everything that is known of it."""

    name: str
    variant: str
    anchor: str
    lines: list[Line]
    figures: list[Figured]
    sheets: list[Sheet]
    runs: list[RunView]
    tally: list[tuple[str, str, int]]
    unexpected: int


@dataclass(frozen=True)
class CaseView:
    """One case: what it asks and its scenes; `table` is its LaTeX table, empty where nothing was compared."""

    info: CaseInfo
    anchor: str
    sweeps: list[Figured]
    scenes: list[SceneView]
    count: int
    unexpected: int
    table: str


@dataclass(frozen=True)
class CodeView:
    """One program: which sources it stands behind and how many of its runs are live, cached, recorded or missing."""

    name: str
    version: str
    package: str
    sources: list[str]
    origins: list[str]


@dataclass(frozen=True)
class Difference:
    """A known difference: its explanation and the comparisons that rest on it."""

    identifier: str
    anchor: str
    explanation: str
    lines: list[Line] = field(default_factory=list[Line])


def reason_of(verdict: str) -> str:
    """What stands in the brackets of a verdict."""
    return verdict.partition("(")[2].removesuffix(")")


def known_anchor(identifier: str) -> str:
    """Where the page explains a known difference."""
    return f"known-{notation.slug(identifier)}"


def line(entry: Entry) -> Line:
    """One comparison in words."""
    item = entry.comparison
    name = kind(item.verdict)
    numbers = (item.left.value, item.left.uncertainty, item.right.value, item.right.uncertainty)
    words = (item.case, item.level, item.check, item.quantity, item.left.source, item.right.source, item.verdict)
    return Line(
        anchor=entry.anchor,
        scene=item.case,
        scene_anchor=f"scene-{notation.slug(item.case)}",
        quantity=item.quantity,
        check=item.check,
        unit="" if item.unit == "-" else item.unit,
        left=_side(item.left),
        right=_side(item.right),
        discrepancy=notation.number(item.discrepancy, 3),
        scale=item.scale,
        bound=notation.number(item.bound, 3),
        bound_source=item.bound_source,
        kind=name,
        reason=reason_of(item.verdict),
        symbol=SYMBOLS.get(name, "!"),
        expected=item.expected,
        unexpected=not item.as_expected,
        bad=notation.is_bad(*numbers, item.discrepancy, item.bound),
        note=item.note,
        kinds=name if item.as_expected else f"{name} unexpected",
        text=" ".join((*words, item.note)).lower(),
    )


def _side(side: Side) -> SideView:
    uncertainty = ""
    if side.uncertainty is not None:
        origin = "" if side.uncertainty_kind in ("", "none") else f" ({side.uncertainty_kind})"
        uncertainty = f"± {notation.number(side.uncertainty, 2)}{origin}"
    bad = notation.is_bad(side.value, side.uncertainty)
    return SideView(side.source, notation.number(side.value), uncertainty, bad, side.recorded)


def unexpected(entries: list[Entry]) -> list[Line]:
    """The comparisons that are not as expected, the worst first."""
    odd = [entry for entry in entries if not entry.comparison.as_expected]
    return [line(entry) for entry in sorted(odd, key=lambda entry: severity(entry.comparison), reverse=True)]


def tally(comparisons: list[Comparison]) -> list[tuple[str, str, int]]:
    """Kind, symbol and number of every kind of verdict that occurs."""
    counts = Counter(kind(item.verdict) for item in comparisons)
    order = [*SYMBOLS, *sorted(set(counts) - set(SYMBOLS))]
    return [(name, SYMBOLS.get(name, "!"), counts[name]) for name in order if counts[name]]


def cases(campaign: Campaign, entries: list[Entry], figures: list[Figured]) -> list[CaseView]:
    """All cases: those described first and in that order, then any that only a verdict or a figure names."""
    infos = {info.name: info for info in campaign.cases}
    sweeps = [figure for figure in figures if figure.sweep]
    curves = [figure for figure in figures if not figure.sweep]
    lists = (
        (entry.comparison.case for entry in entries),
        (figure.scene for figure in curves),
        (run.scene for run in campaign.runs),
        (key.rpartition("|")[0] for key in campaign.translations),
    )
    scenes = list(dict.fromkeys(scene for names in lists for scene in names))
    sheets = _sheets(campaign, scenes)
    views = [_scene(campaign, scene, entries, curves, sheets.get(scene, [])) for scene in scenes]
    names = list(dict.fromkeys([*infos, *map(case_of, scenes), *(figure.scene for figure in sweeps)]))
    out: list[CaseView] = []
    for name in names:
        info = infos.get(name) or CaseInfo(name, "(no description was given for this case)", "?", "", [])
        mine = [view for view in views if case_of(view.name) == name]
        shown = [figure for figure in sweeps if figure.scene == name]
        odd = sum(view.unexpected for view in mine)
        count = sum(len(view.lines) for view in mine)
        out.append(
            CaseView(
                info, f"case-{notation.slug(name)}", shown, mine, count, odd, tables.path_of(name) if count else ""
            )
        )
    return out


def _scene(
    campaign: Campaign, scene: str, entries: list[Entry], curves: list[Figured], sheets: list[Sheet]
) -> SceneView:
    mine = [entry for entry in entries if entry.comparison.case == scene]
    runs = [run for run in campaign.runs if run.scene == scene]
    lines = [line(entry) for entry in mine]
    return SceneView(
        name=scene,
        variant=variant_of(scene),
        anchor=f"scene-{notation.slug(scene)}",
        lines=lines,
        figures=[figure for figure in curves if figure.scene == scene],
        sheets=sheets,
        runs=[_run(run) for run in runs],
        tally=tally([entry.comparison for entry in mine]),
        unexpected=sum(shown.unexpected for shown in lines),
    )


def _run(run: SourceRun) -> RunView:
    return RunView(run, notation.span(run.wall_time), notation.number(run.time_step, 6), run.origin.replace(" ", "-"))


def _sheets(campaign: Campaign, scenes: list[str]) -> dict[str, list[Sheet]]:
    shown: dict[str, str] = {}
    out: dict[str, list[Sheet]] = {}
    for scene in scenes:
        for key, (text, rows) in campaign.translations.items():
            name, _, code = key.rpartition("|")
            if name != scene:
                continue
            anchor = f"deck-{notation.slug(key)}"
            first = shown.setdefault(text, anchor)
            kept, cut = _cut(text)
            sheet = Sheet(
                anchor,
                code,
                rows[:SHEET_ROWS],
                max(len(rows) - SHEET_ROWS, 0),
                kept,
                cut,
                "" if first == anchor else first,
            )
            out.setdefault(scene, []).append(sheet)
    return out


def _cut(text: str) -> tuple[str, int]:
    if len(text) <= DECK_LETTERS:
        return text, 0
    cut = len(text) - DECK_LETTERS
    head, tail = text[: DECK_LETTERS - DECK_TAIL], text[-DECK_TAIL:]
    return f"{head}\n\n[... {cut} characters are left out here ...]\n\n{tail}", cut


def codes(runs: list[SourceRun]) -> list[CodeView]:
    """The programs behind the runs."""
    groups: dict[tuple[str, str, str], list[SourceRun]] = {}
    for run in runs:
        groups.setdefault((run.code, run.version, run.package), []).append(run)
    out: list[CodeView] = []
    for (name, version, package), mine in groups.items():
        counts = Counter(run.origin for run in mine)
        order = [*ORIGINS, *sorted(set(counts) - set(ORIGINS))]
        origins = [f"{counts[origin]} {origin}" for origin in order if counts[origin]]
        out.append(CodeView(name, version, package, list(dict.fromkeys(run.source for run in mine)), origins))
    return out


def differences(campaign: Campaign, entries: list[Entry]) -> list[Difference]:
    """The known differences: those listed, and any that a verdict names without an explanation."""
    used: dict[str, list[Line]] = {}
    for entry in entries:
        if kind(entry.comparison.verdict) == "known-difference":
            used.setdefault(reason_of(entry.comparison.verdict), []).append(line(entry))
    missing = "No explanation is on file for this id: known_differences.toml must list it."
    explanations = dict.fromkeys(used, missing) | campaign.known_differences
    return [Difference(name, known_anchor(name), text, used.get(name, [])) for name, text in explanations.items()]
