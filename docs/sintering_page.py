"""Writes docs/sintering-results.md from the table of a study: python docs/sintering_page.py out/sintering-full DATE."""

from __future__ import annotations

import csv
import sys
from pathlib import Path

from cross_check.report.notation import ABSENT

HEAD = """# What the sintering study found

Written by `docs/sintering_page.py` from `table.csv` of `cross-check run sintering --full` of {date}. Each row is a
claim of Luding, Manetsberger and Müllers (2005) with the threshold that was set for it beforehand; a cell is the mean
over the seeds with their standard deviation, and in brackets how many of them keep the threshold alone. A claim that
the model does not reproduce is **missed** and stays. What the numbers are is said in
[the sintering study](sintering.md).

{summary}

"""
SAMPLES = (("10", "100"), ("10", "300"), ("100", "100"), ("100", "300"), ("10", "3"), ("100", "3"))
CLAIM = ("Target", "Claim", "Paper", "Threshold")
Row = dict[str, str]


def _cell(row: Row | None) -> str:
    if row is None:
        return ""
    spread = "" if row["Spread"] in ("", ABSENT) else f" ± {row['Spread']}"
    kept = "" if row["Kept by"] in ("", ABSENT) else f" ({row['Kept by']}/{row['Seeds']})"
    verdict = f" **{row['Verdict']}**" if row["Verdict"] not in ("met", "reported") else ""
    return f"{row['Measured']}{spread}{kept}{verdict}"


def _summary(rows: list[Row]) -> str:
    """How many targets are met, and which are not."""
    judged = [row for row in rows if row["Threshold"] not in ("", ABSENT)]
    missed = [row for row in judged if row["Verdict"] != "met"]
    text = f"{len(judged) - len(missed)} of {len(judged)} targets are met."
    if missed:
        lines = [f"- {row['Target']}, p = {row['p [N/m]']} N/m, N = {row['N']}: {row['Verdict']}" for row in missed]
        text += " The others:\n\n" + "\n".join(lines)
    return text


def page(table: Path, date: str) -> str:
    """The page of a study's table."""
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    claims: dict[tuple[str, ...], dict[tuple[str, str], Row]] = {}
    for row in rows:
        claims.setdefault(tuple(row[key] for key in CLAIM), {})[row["p [N/m]"], row["N"]] = row
    used = [sample for sample in SAMPLES if any(sample in found for found in claims.values())]
    heads = [*CLAIM, *(f"p = {pressure}, N = {count}" for pressure, count in used)]
    lines = [f"| {' | '.join(heads)} |", f"|{'---|' * len(heads)}"]
    for claim, found in claims.items():
        cells = [text.replace("|", "\\|") for text in (*claim, *(_cell(found.get(sample)) for sample in used))]
        lines.append(f"| {' | '.join(cells)} |")
    return HEAD.format(date=date, summary=_summary(rows)) + "\n".join(lines) + "\n"


if __name__ == "__main__":
    folder, date = sys.argv[1:]
    Path(__file__).with_name("sintering-results.md").write_text(page(Path(folder) / "table.csv", date))
