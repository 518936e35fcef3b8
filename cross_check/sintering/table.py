"""The table *paper - measured - verdict* as Markdown, CSV and LaTeX."""

from __future__ import annotations

import csv
from pathlib import Path

from cross_check.report import notation, tables
from cross_check.sintering.targets import Row

HEAD = ("Target", "p [N/m]", "N", "Claim", "Paper", "Threshold", "Measured", "Spread", "Seeds", "Kept by", "Verdict")


def write_all(rows: list[Row], folder: Path) -> None:
    """Writes `table.md`, `table.csv` and `table.tex`."""
    (folder / "table.md").write_text(markdown(rows), encoding="utf-8")
    (folder / "table.tex").write_text(latex(rows), encoding="utf-8")
    with (folder / "table.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow((*HEAD, "Note"))
        for row in rows:
            note = "" if row.evidence is None else row.evidence.note
            writer.writerow((*cells(row, 8), "; ".join(part for part in (note, row.reason) if part)))


def cells(row: Row, digits: int = 4) -> tuple[str, ...]:
    """A row as text: value, standard deviation over the seeds, and how many of them keep the threshold alone."""
    target, evidence = row.target, row.evidence
    measured = notation.ABSENT if evidence is None else notation.number(evidence.value, digits)
    unit = "" if evidence is None or target.unit == "-" else f" {target.unit}"
    return (
        target.id,
        str(target.sample.pressure),
        str(target.sample.count),
        target.claim,
        target.paper,
        target.threshold or notation.ABSENT,
        measured + unit,
        notation.number(row.spread, min(digits, 3)),
        notation.ABSENT if evidence is None else str(len(evidence.seeds)),
        str(row.kept_by) if evidence is not None and target.gated else notation.ABSENT,
        row.verdict,
    )


def markdown(rows: list[Row]) -> str:
    """A table that GitHub and Sphinx read."""
    lines = [f"| {' | '.join(HEAD)} |", f"|{'---|' * len(HEAD)}"]
    lines += ["| " + " | ".join(text.replace("|", "\\|") for text in cells(row)) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def latex(rows: list[Row]) -> str:
    """A table for papers (booktabs, longtable)."""
    body = [" & ".join(tables.escape(text) for text in cells(row)) + r" \\" for row in rows]
    lines = [
        r"% Targets of the sintering study; needs \usepackage{booktabs,longtable}.",
        r"\begin{longtable}{lrrp{4cm}p{2cm}p{4cm}rrrrl}",
        r"\toprule",
        " & ".join(tables.escape(text) for text in HEAD) + r" \\",
        r"\midrule",
        r"\endhead",
        *body,
        r"\bottomrule",
        r"\end{longtable}",
    ]
    return "\n".join(lines) + "\n"
