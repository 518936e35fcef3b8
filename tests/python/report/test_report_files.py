"""Claims about verdicts.json, junit.xml and the LaTeX tables."""

from __future__ import annotations

import json
import math
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest
import synthetic_campaign
from synthetic_campaign import Written

from cross_check.compare.verdicts import Comparison, kind
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
    assert r"differ$^{\dagger}$" in text
    assert r"\textbf{NaN}" in text
    assert r"\toprule" in text
    assert "\\begin{longtable}" in text


def test_latex_heads_carry_the_unit_and_notes_the_reason(odd: Written) -> None:
    text = (odd.folder / "report" / "tables" / "chung-ooi-1.tex").read_text(encoding="utf-8")
    assert r"\textit{peak normal force} {[}N{]}" in text
    assert text.count("LAMMPS has no switch for the cut at zero") == 1
    assert re.search(r"known-difference\$\^\{\d+\}\$", text)
    assert "lammps (recorded)" in text
    assert "not the expected verdict" in text


def hostile() -> list[Comparison]:
    """Comparisons whose texts hold every printable sign of ASCII, and letters that LaTeX does not know."""
    signs = "".join(chr(number) for number in range(32, 127))
    texts = (
        signs,
        "[2] starts like an argument",
        "* so does this",
        "--long-option",
        "50 °, µm², \u03b1 ≤ \u2013 \u2603\u4e2d\x07 \t end",
    )
    return [
        replace(
            synthetic_campaign.comparison(f"case/{text}", text, "b", quantity=text, unit=text),
            verdict=f"not-comparable({text})",
            discrepancy=value,
        )
        for text in texts
        for value in (None, math.nan, -math.inf, 0.0, 1.5e-300)
    ]


@pytest.mark.parametrize("copies", [1, 3], ids=["tabular", "longtable"])
def test_every_latex_table_compiles(odd: Written, tmp_path: Path, copies: int) -> None:
    name = "odd % \\ \u4e2d\nname"
    own = tables.table(name, hostile() * copies)
    assert ("longtable" in own) == (copies > 1)
    written = [path.read_text(encoding="utf-8") for path in sorted((odd.folder / "report" / "tables").glob("*.tex"))]
    for text in (own, *written):
        check_rows(text)
    program = shutil.which("pdflatex")
    if program is None:
        return  # the check of the rows has to do
    paper = r"\documentclass{article}\usepackage{booktabs,longtable}\begin{document}"
    parts = "".join(rf"\input{{{number}.tex}}\par " for number in range(1 + len(written)))
    for number, text in enumerate((own, *written)):
        (tmp_path / f"{number}.tex").write_text(text, encoding="utf-8")
    (tmp_path / "paper.tex").write_text(paper + parts + r"\end{document}")
    command = [program, "-halt-on-error", "-interaction=nonstopmode", "-no-shell-escape", "paper.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, timeout=60, check=False)
    assert done.returncode == 0, done.stdout[-2000:]


def check_rows(text: str) -> None:
    """Every row has the columns that the table declares, braces close, and no sign acts that should be printed."""
    declared = re.search(r"\\begin\{(tabular|longtable)\}\{([lr]+)\}", text)
    assert declared is not None
    assert text.endswith(f"\\end{{{declared[1]}}}\n")
    for row in (line for line in text.splitlines() if line.endswith(r" \\")):
        plain = re.sub(r"\\[\\{}&%$#_]", "", row.removesuffix(r" \\"))
        assert plain.isascii()
        assert not row.startswith(("*", "[")), row
        assert not re.search(r"--\w", plain), row
        depth = 0
        for letter in plain:
            depth += {"{": 1, "}": -1}.get(letter, 0)
            assert depth >= 0, row
        assert depth == 0, row
        assert plain.count("$") % 2 == 0, row
        assert not re.search(r"[%#~]|_(?!\{)", plain), row
        assert plain.startswith(r"\multicolumn{8}") or plain.count("&") == len(declared[2]) - 1, row


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
