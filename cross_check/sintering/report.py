"""Writes what the study found: verdicts, table, figures and the page."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cross_check import campaign
from cross_check.compare.verdicts import Comparison
from cross_check.report import junit, page, verdict_file
from cross_check.report import tables as case_tables
from cross_check.report.campaign import Campaign, CaseInfo, SourceRun
from cross_check.sintering import figures, table
from cross_check.sintering.judgement import SUITE
from cross_check.sintering.study import Study
from cross_check.sintering.targets import LEFT_OUT, Row

QUESTION = "Which claims of the paper on long-time sintering does its model reproduce, over several seeds?"
SOURCE = "S. Luding, K. Manetsberger and J. Müllers, J. Mech. Phys. Solids 53 (2005) 455"


@dataclass(frozen=True)
class Started:
    """When the study was started, as text, and how long it took [s]."""

    started: str
    duration: float


def write(
    out: Path, study: Study, rows: list[Row], verdicts: list[Comparison], started: Started, draw: bool = True
) -> Path:
    """Writes everything into `out`, figures if `draw`; returns the path of the page."""
    report = out / "report"
    report.mkdir(parents=True, exist_ok=True)
    table.write_all(rows, out)
    drawn, missing = figures.draw_all(study, out / "figures") if draw else ([], [])
    info = CaseInfo(SUITE, QUESTION, "L5", SOURCE, list(dict.fromkeys(row.target.id for row in rows)))
    left_out = [f"{sum(row.verdict == LEFT_OUT for row in rows)} targets, which run with --full"]
    summary = Campaign(
        suite=SUITE,
        started=started.started,
        duration=started.duration,
        comparisons=verdicts,
        cases=[info],
        runs=_provenance(study),
        environment=campaign.environment(),
        left_out=[*(left_out if not study.full else []), *missing],
    )
    verdict_file.write(out / "verdicts.json", verdicts)
    junit.write(out / "junit.xml", summary)
    case_tables.write_all(summary, report / "tables")
    path = report / "index.html"
    for item in drawn:  # the page and its figures may be moved together
        for suffix in ("svg", "pdf"):
            place = report / "figures" / f"{item.name}.{suffix}"
            place.parent.mkdir(exist_ok=True)
            place.write_bytes((out / "figures" / place.name).read_bytes())
    path.write_text(page.render(summary, drawn), encoding="utf-8")
    return path


def _provenance(study: Study) -> list[SourceRun]:
    """Where each run comes from."""
    package, found = campaign.environment()[2]
    return [
        SourceRun(
            f"{SUITE}/p={run.pressure},N={run.count}", "native", "crossgrain", found, package, outcome.origin, "",
            outcome.machine, outcome.wall_time, outcome.steps, outcome.time_step,
            f"{run.name}: {outcome.failure}" if outcome.failure else run.name,
        )
        for run, outcome in study.outcomes.items()
    ]  # fmt: skip
