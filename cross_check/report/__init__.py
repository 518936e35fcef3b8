"""The report: reads verdicts, curves and provenance of a campaign and shows them; it computes no physics."""

from __future__ import annotations

from pathlib import Path

from cross_check.report import figures, junit, page, tables, trends, verdict_file
from cross_check.report.campaign import Campaign

__all__ = ["write"]


def write(folder: Path, campaign: Campaign, pdf: bool = True) -> Path:
    """Writes verdicts.json, junit.xml and report/ with its page, figures and tables; returns the page's path."""
    report = folder / "report"
    for old in (*report.glob("figures/*.svg"), *report.glob("figures/*.pdf"), *report.glob("tables/*.tex")):
        old.unlink()  # of a report that stood here before
    report.mkdir(parents=True, exist_ok=True)
    verdict_file.write(folder / "verdicts.json", campaign.comparisons)
    junit.write(folder / "junit.xml", campaign)
    tables.write_all(campaign, report / "tables")
    over_time = trends.drawings(campaign.trends, report / "figures", pdf)
    drawn = figures.draw_all(campaign, report / "figures", pdf, over_time)
    first = len(drawn) - len(over_time)
    path = report / "index.html"
    path.write_text(page.render(campaign, drawn[:first], drawn[first:]), encoding="utf-8")
    return path
