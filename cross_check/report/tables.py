"""LaTeX tables (booktabs) of the comparisons, one file per case, for papers."""

from __future__ import annotations

import math
import re
from pathlib import Path

from cross_check.compare.verdicts import Comparison
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
}
HEAD = "Scene & Quantity & Left & Right & Left value & Right value & Unit & Discrepancy & Bound & Verdict"
COLUMNS = "llllrrlrrl"


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
    """The table of one case. A verdict that is not the expected one carries a dagger."""
    long = len(comparisons) > LONG
    environment = "longtable" if long else "tabular"
    packages = r"\usepackage{booktabs,longtable}" if long else r"\usepackage{booktabs}"
    name = re.sub(r"\s+", " ", case)
    lines = [
        f"% {name}: comparisons of cross-check; needs {packages}. Discrepancies are relative to the scale of each row.",
        rf"\begin{{{environment}}}{{{COLUMNS}}}",
        r"\toprule",
        rf"{HEAD} \\",
        r"\midrule",
        *([r"\endhead"] if long else []),
        *(_row(comparison) for comparison in comparisons),
        r"\bottomrule",
        rf"\end{{{environment}}}",
    ]
    return "\n".join(lines) + "\n"


def _row(comparison: Comparison) -> str:
    verdict = escape(comparison.verdict)
    if not comparison.as_expected:
        verdict += r"$^\dagger$"
    cells = [
        escape(variant_of(comparison.case)),
        escape(comparison.quantity),
        escape(comparison.left.source),
        escape(comparison.right.source),
        figure(comparison.left.value, 8),
        figure(comparison.right.value, 8),
        escape(comparison.unit),
        figure(comparison.discrepancy, 2),
        figure(comparison.bound, 2),
        verdict,
    ]
    return " & ".join(cells) + r" \\"


def escape(text: str) -> str:
    """Text that LaTeX prints as it stands."""
    return "".join(SPECIAL.get(letter, letter) for letter in re.sub(r"\s+", " ", text))


def figure(value: float | None, digits: int) -> str:
    """A number in math mode, powers of ten written out."""
    if value is None:
        return "--"
    if not math.isfinite(value):
        return rf"\textbf{{{notation.number(value)}}}"
    mantissa, mark, exponent = notation.number(value, digits).partition("e")
    return rf"${mantissa}\times10^{{{exponent}}}$" if mark else f"${mantissa}$"
