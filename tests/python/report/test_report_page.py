"""Claims about the HTML page."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import synthetic_campaign
from synthetic_campaign import SCRIPT, Written

from cross_check import report
from cross_check.report import page
from cross_check.report.campaign import Campaign

MOST_BYTES = 8e6 * 6 / 45  # the page of 45 scenes stays below 8 MB


def section(text: str, name: str) -> str:
    """The HTML of one section."""
    found = re.search(rf'<section id="{name}".*?</section>', text, re.DOTALL)
    assert found is not None, name
    return found.group(0)


def test_all_as_expected_is_said_in_one_sentence() -> None:
    campaign = synthetic_campaign.build(3)
    text = page.render(campaign, [])
    assert f"<h1>{len(campaign.comparisons)} comparisons: all as expected</h1>" in text
    assert 'id="unexpected"' not in text


def test_nothing_compared_is_not_a_success() -> None:
    text = page.render(Campaign("laws", "today", 0.0, [], []), [])
    assert '<div class="result alarm"' in text
    assert "nothing was judged" in text


def test_unexpected_verdicts_are_counted_and_come_first(odd: Written) -> None:
    assert f"<h1>3 of {len(odd.campaign.comparisons)} comparisons are not as expected</h1>" in odd.page
    listed = section(odd.page, "unexpected")
    assert listed.count('<tr class="odd"') == 3
    assert "expected agree" in listed
    assert odd.page.index('id="unexpected"') < odd.page.index('id="matrix"')


def test_nan_is_shown(odd: Written) -> None:
    assert '<span class="value bad">NaN' in section(odd.page, "unexpected")
    assert "NaN / 1e-9" in section(odd.page, "matrix")


def test_text_of_others_is_escaped(odd: Written) -> None:
    assert "alert(" in odd.page
    assert SCRIPT not in odd.page
    assert odd.page.count("<script") == 1


def test_page_needs_no_other_file(odd: Written) -> None:
    assert re.findall(r"https?://|\bsrc=|@import|<link\b", odd.page) == []
    assert len(odd.page.encode()) < MOST_BYTES


def test_every_link_leads_somewhere_and_anchors_are_unique(odd: Written) -> None:
    anchors = re.findall(r'\bid="([^"]*)"', odd.page)
    assert len(anchors) == len(set(anchors))
    assert set(re.findall(r'href="#([^"]*)"', odd.page)) | set(re.findall(r"url\(#([^)]*)\)", odd.page)) <= set(anchors)


def test_tables_and_figures_are_linked_and_lie_beside_the_page(odd: Written) -> None:
    links = set(re.findall(r'href="([^#"]*)"', odd.page))
    report = odd.folder / "report"
    files = {path.relative_to(report).as_posix() for path in report.glob("*/*")}
    assert links == files
    assert {link.rpartition(".")[2] for link in links} == {"tex", "svg", "pdf"}


def test_dark_scheme_and_print_are_styled(odd: Written) -> None:
    assert "(prefers-color-scheme: dark)" in odd.page
    assert "@media print" in odd.page


def test_every_scene_has_its_figures_decks_and_provenance(odd: Written) -> None:
    campaign = odd.campaign
    assert odd.page.count("<svg") == len(campaign.curves) + len(campaign.sweeps)
    assert odd.page.count("Translation into") == len(campaign.translations)
    assert odd.page.count(">Provenance ") == len({run.scene for run in campaign.runs})


def test_recorded_runs_are_marked(odd: Written) -> None:
    recorded = sum(item.left.recorded or item.right.recorded for item in odd.campaign.comparisons)
    assert f"<b>{recorded} of {len(odd.campaign.comparisons)}</b> comparisons rest on a recorded run" in odd.page
    assert "<em>recorded</em>" in section(odd.page, "matrix")


def test_known_difference_without_explanation_is_reported(odd: Written) -> None:
    known = section(odd.page, "known-differences")
    assert "YADE never cuts" in known
    assert "nobody-explained-this" in known
    assert "No explanation is on file" in known


def test_equal_decks_are_shown_once() -> None:
    campaign = synthetic_campaign.build(3)
    (key, (text, rows)), (other, _), *_ = campaign.translations.items()
    text_of_page = page.render(replace(campaign, translations={key: (text, rows), other: (text, rows)}), [])
    assert text_of_page.count("<pre") == 1
    assert "the same as shown here" in text_of_page


def test_long_decks_are_cut_and_say_so() -> None:
    campaign = synthetic_campaign.build(3)
    key = next(iter(campaign.translations))
    text = page.render(replace(campaign, translations={key: ("x" * 100_000, [])}), [])
    assert "70000 characters are left out" in text


def test_files_of_an_older_report_are_removed(tmp_path: Path) -> None:
    old = tmp_path / "report" / "tables" / "gone.tex"
    old.parent.mkdir(parents=True)
    old.write_text("old")
    report.write(tmp_path, Campaign("laws", "today", 1.0, [], []))
    assert not old.exists()
