"""Claims about verdicts.json, junit.xml and the LaTeX tables."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import synthetic_campaign
from synthetic_campaign import Written

from cross_check.compare.verdicts import kind
from cross_check.report import junit, notation, tables, verdict_file


def parsed(path: Path) -> ElementTree.Element:
    """The root of an XML file."""
    return ElementTree.fromstring(path.read_bytes())  # noqa: S314  # written by this very test


def test_verdicts_survive_the_file(odd: Written) -> None:
    read = verdict_file.read(odd.folder / "verdicts.json")
    for before, after in zip(odd.campaign.comparisons, read, strict=True):
        assert repr(before) == repr(after)  # repr: NaN is not equal to itself


def test_verdicts_are_strict_json_with_the_keys_of_the_contract(odd: Written) -> None:
    def refuse(name: str) -> None:
        raise AssertionError(f"{name} is not JSON")

    text = (odd.folder / "verdicts.json").read_text(encoding="utf-8")
    lines = json.loads(text, parse_constant=refuse)
    assert {"case", "level", "quantity", "unit", "left", "right", "discrepancy", "bound"} <= set(lines[0])
    assert {"bound_source", "verdict", "expected", "note"} <= set(lines[0])
    assert {"source", "value", "uncertainty"} <= set(lines[0]["left"])
    assert lines[5]["discrepancy"] == "NaN"


def test_junit_fails_what_is_not_expected_and_skips_what_was_foreseen(odd: Written) -> None:
    root = parsed(odd.folder / "junit.xml")
    comparisons = odd.campaign.comparisons
    skips = sum(item.as_expected and kind(item.verdict) in junit.SKIPPED for item in comparisons)
    assert len(root.findall("testsuite")) == 2
    assert len(root.findall("testsuite/testcase")) == len(comparisons) == int(root.attrib["tests"])
    assert len(root.findall("testsuite/testcase/failure")) == 3 == int(root.attrib["failures"])
    assert len(root.findall("testsuite/testcase/skipped")) == skips == int(root.attrib["skipped"])


def test_junit_names_the_comparison_and_says_what_happened(odd: Written) -> None:
    root = parsed(odd.folder / "junit.xml")
    scene = "chung-ooi-1/glass/e=0.1"
    case = root.find(f"testsuite/testcase[@name='{scene} peak normal force lammps vs reference']")
    assert case is not None
    failure = case.find("failure")
    assert failure is not None
    assert failure.attrib["message"] == "differ, expected agree"
    assert "discrepancy: 0.00023 of peak force" in (failure.text or "")


def test_junit_names_are_unique(tmp_path: Path) -> None:
    campaign = synthetic_campaign.build(1)
    twin = replace(campaign.comparisons[0], check="another_check")
    junit.write(tmp_path / "junit.xml", replace(campaign, comparisons=[campaign.comparisons[0], twin]))
    names = [case.attrib["name"] for case in parsed(tmp_path / "junit.xml").iter("testcase")]
    assert len(set(names)) == 2


def test_latex_table_escapes_and_marks(odd: Written) -> None:
    text = (odd.folder / "report" / "tables" / "chung-ooi-1.tex").read_text(encoding="utf-8")
    assert r"$2.3\times10^{-4}$" in text or r"$0.00023$" in text
    assert r"differ$^\dagger$" in text
    assert r"\textbf{NaN}" in text
    assert r"\toprule" in text
    assert "\\begin{longtable}" in text


def test_latex_escapes_every_special_character() -> None:
    assert tables.escape("50% of a_b & {c} #1 ~ ^ \\") == (
        r"50\% of a\_b \& \{c\} \#1 \textasciitilde{} \textasciicircum{} \textbackslash{}"
    )


def test_numbers_are_written_without_loss_of_what_matters() -> None:
    assert notation.number(10.694812345678901) == "10.69481235"
    assert notation.number(3.0e-9, 3) == "3e-9"
    assert notation.number(None) == notation.ABSENT
    assert notation.number(math.nan) == "NaN"
    assert notation.number(-math.inf) == "-infinite"
    assert [notation.short(value) for value in (3.14159e-14, 0.0, 0.021, 123456.0)] == [
        "3.1e-14",
        "0",
        "0.021",
        "1.2e5",
    ]


def test_slugs_of_different_names_differ() -> None:
    names = ["a/b", "a-b", "a b", "A-b", "a=b", "glass/e=0.1", "glass/e=0,1", "…"]
    assert len({notation.slug(name) for name in names}) == len(names)
