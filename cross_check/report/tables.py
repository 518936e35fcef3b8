"""LaTeX tables (booktabs) of the comparisons, one file per case, for papers."""

from __future__ import annotations

import math
import re
from pathlib import Path

from cross_check.compare.verdicts import Comparison, Side, kind
from cross_check.report import notation
from cross_check.report.campaign import Campaign, case_of, variant_of

LONG = 40  # rows from which a table may break over pages
SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    "µ": r"\ensuremath{\mu}",
    "μ": r"\ensuremath{\mu}",
    "·": r"\ensuremath{\cdot}",
    "²": r"\ensuremath{^2}",
    "³": r"\ensuremath{^3}",
    "°": r"\ensuremath{^\circ}",
    "\N{MINUS SIGN}": r"\ensuremath{-}",
    "\N{EN DASH}": r"\textendash{}",
    "\N{MULTIPLICATION SIGN}": r"\ensuremath{\times}",
    "≤": r"\ensuremath{\leq}",
    "≥": r"\ensuremath{\geq}",
    "≠": r"\ensuremath{\neq}",
    "±": r"\ensuremath{\pm}",
    # A row that begins with a bracket or a star would else be read as an argument of the end of the row above.
    "*": "{*}",
    "[": "{[}",
    "]": "{]}",
}
HEAD = ("Scene", "Left", "Right", "Left value", "Right value", "Discrepancy", "Bound", "Verdict")
COLUMNS = "lllrrrrl"


def write_all(campaign: Campaign, folder: Path) -> list[Path]:
    """Writes one table per case that has comparisons; returns the paths."""
    folder.mkdir(parents=True, exist_ok=True)
    cases: dict[str, list[Comparison]] = {}
    for comparison in campaign.comparisons:
        cases.setdefault(case_of(comparison.case), []).append(comparison)
    paths: list[Path] = []
    for case, comparisons in cases.items():
        path = folder / f"{notation.slug(case)}.tex"
        path.write_text(table(case, comparisons), encoding="utf-8")
        paths.append(path)
    return paths


def table(case: str, comparisons: list[Comparison]) -> str:
    """The table of one case: quantities with their units in heads of their own, the scenes below them.

    A verdict that is not the expected one carries a dagger; numbers lead to the reasons of verdicts, below the table.
    """
    long = len(comparisons) > LONG
    environment = "longtable" if long else "tabular"
    packages = r"\usepackage{booktabs,longtable}" if long else r"\usepackage{booktabs}"
    quantities: dict[tuple[str, str], list[Comparison]] = {}
    for comparison in comparisons:
        quantities.setdefault((comparison.quantity, comparison.unit), []).append(comparison)
    notes: list[str] = []
    body: list[str] = []
    for (quantity, unit), group in quantities.items():
        body += [r"\midrule", _across(rf"\textit{{{escape(quantity)}}} {{[}}{escape(unit)}{{]}}"), r"\midrule"]
        body += [_row(comparison, notes) for comparison in group]
    lines = [
        f"% {comment(case)}: comparisons of cross-check; needs {packages}.",
        "% Values are in the unit of their quantity, discrepancies and bounds relative to the scale of the comparison.",
        rf"\begin{{{environment}}}{{{COLUMNS}}}",
        r"\toprule",
        " & ".join(HEAD) + r" \\",
        *([r"\endhead"] if long else []),
        *body,
        r"\bottomrule",
        *_foot(notes, any(not comparison.as_expected for comparison in comparisons)),
        rf"\end{{{environment}}}",
    ]
    return "\n".join(lines) + "\n"


def _across(text: str) -> str:
    return rf"\multicolumn{{{len(COLUMNS)}}}{{l}}{{{text}}} \\"


def _foot(notes: list[str], unexpected: bool) -> list[str]:
    """The reasons of verdicts, broken into lines as wide as the text."""
    marked = [rf"${number}$\enspace {escape(note)}" for number, note in enumerate(notes, start=1)]
    if unexpected:
        marked.append(r"$\dagger$\enspace not the expected verdict")
    paragraph = rf"\multicolumn{{{len(COLUMNS)}}}{{p{{0.95\linewidth}}}}"
    return [rf"{paragraph}{{\footnotesize {text}}} \\" for text in marked]


def _row(comparison: Comparison, notes: list[str]) -> str:
    reason = comparison.verdict.partition("(")[2].removesuffix(")")
    if reason and reason not in notes:
        notes.append(reason)
    marks = ([str(notes.index(reason) + 1)] if reason else []) + ([] if comparison.as_expected else [r"\dagger"])
    cells = [
        escape(variant_of(comparison.case)),
        _source(comparison.left),
        _source(comparison.right),
        figure(comparison.left.value, 8),
        figure(comparison.right.value, 8),
        figure(comparison.discrepancy, 2),
        figure(comparison.bound, 2),
        escape(kind(comparison.verdict)) + (rf"$^{{{','.join(marks)}}}$" if marks else ""),
    ]
    return " & ".join(cells) + r" \\"


def _source(side: Side) -> str:
    return escape(side.source) + (" (recorded)" if side.recorded else "")


def comment(text: str) -> str:
    """Text for a comment: one line of letters that every LaTeX reads."""
    return re.sub(r"\s+", " ", text).encode("ascii", "replace").decode()


def escape(text: str) -> str:
    """Text that LaTeX prints as it stands; a letter that it may not know becomes its code point."""
    plain = re.sub(r"\s+", " ", text)
    return re.sub("-(?=-)", "-{}", "".join(SPECIAL.get(letter, _letter(letter)) for letter in plain))


def _letter(letter: str) -> str:
    return letter if letter.isascii() and letter.isprintable() else f"{{[}}U+{ord(letter):04X}{{]}}"


def path_of(case: str) -> str:
    """The file of a case's table, seen from the folder of the report."""
    return f"tables/{notation.slug(case)}.tex"


def figure(value: float | None, digits: int) -> str:
    """A number in math mode, powers of ten written out."""
    if value is None:
        return "--"
    if not math.isfinite(value):
        return rf"\textbf{{{notation.number(value)}}}"
    mantissa, mark, exponent = notation.number(value, digits).partition("e")
    return rf"${mantissa}\times10^{{{exponent}}}$" if mark else f"${mantissa}$"
