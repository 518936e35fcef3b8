"""The report as one HTML page: no network, no files beside it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from cross_check.compare.verdicts import Comparison, kind
from cross_check.report import changes, matrix, notation, views
from cross_check.report.campaign import Campaign
from cross_check.report.figures import Figured
from cross_check.report.matrix import SYMBOLS, Entry
from cross_check.report.palette import DARK, LIGHT, look, mirrored

TEMPLATES = Path(__file__).with_name("templates")
MEANINGS = {
    "agree": "The two values lie within the bound of each other.",
    "differ": "They do not. Where this is expected, the note says why it is shown all the same.",
    "inconclusive": "No power to decide: the uncertainty (time step, scatter over seeds) is larger than the bound.",
    "known-difference": "The codes compute different things, and the size of the difference is predicted and met.",
    "not-comparable": "One side has no form for what the case asks. It is never approximated in silence.",
    "not-run": "There is no result: the code is not installed, the run failed, or only the full suite has it.",
}
LEVELS = {
    "L0": "law: one contact along a prescribed path",
    "L1": "collision: free impacts of two bodies",
    "L2": "snapshot: forces in one many-body state",
    "L3": "trajectory: growth of the difference in a short run",
    "L4": "ensemble: bulk observables over seeds",
    "L5": "nature: closed forms, published tables, experiments",
}


def sentence(comparisons: list[Comparison]) -> tuple[str, bool]:
    """The result in one sentence, and whether all is as expected. Nothing compared is not a success."""
    count = len(comparisons)
    noun = "comparison" if count == 1 else "comparisons"
    odd = sum(not item.as_expected for item in comparisons)
    if count == 0:
        return "No comparisons: nothing was judged", False
    if odd:
        return f"{odd} of {count} {noun} {'is' if odd == 1 else 'are'} not as expected", False
    return f"{count} {noun}: all as expected", True


def render(campaign: Campaign, figures: list[Figured], trends: Sequence[Figured] = ()) -> str:
    """The whole page as text."""
    entries = [Entry(f"c{place}", item) for place, item in enumerate(campaign.comparisons, start=1)]
    counts = Counter(kind(item.verdict) for item in campaign.comparisons)
    kinds = [*SYMBOLS, *sorted(set(counts) - set(SYMBOLS))]
    result, good = sentence(campaign.comparisons)
    recorded = sum(item.left.recorded or item.right.recorded for item in campaign.comparisons)
    context: dict[str, Any] = {
        "campaign": campaign,
        "duration": notation.span(campaign.duration),
        "sentence": result,
        "good": good,
        "total": len(entries),
        "recorded": recorded,
        "kinds": [(name, SYMBOLS.get(name, "!"), counts[name], MEANINGS.get(name, "")) for name in kinds],
        "levels": LEVELS,
        "unexpected": views.unexpected(entries),
        "matrix": matrix.build(entries),
        "cases": views.cases(campaign, entries, figures),
        "codes": views.codes(campaign.runs),
        "differences": views.differences(campaign, entries),
        "changes": changes.views(campaign.changes),
        "trends": trends,
        "light": LIGHT,
        "dark": DARK,
        "symbols": SYMBOLS,
    }
    return _environment().get_template("page.html.j2").render(context)


def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    filters: dict[str, Any] = {
        "hue": _hue,
        "is_mirror": _is_mirror,
        "svg": _svg,
        "breakable": _breakable,
        "known": views.known_anchor,
    }
    environment.filters.update(filters)
    return environment


def _hue(source: str) -> str:
    return look(source).hue


def _is_mirror(source: str) -> bool:
    return mirrored(source) is not None


def _svg(figure: Figured) -> Markup:
    return Markup(figure.svg)  # noqa: S704  # drawn by matplotlib, which escapes every text in it


def _breakable(source: str) -> Markup:
    """A source whose name may break before the bracket."""
    return escape(source).replace("[", Markup("<wbr>["))
