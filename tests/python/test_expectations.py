"""Green is never the default: what is not expected, or no longer there, is a failure."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from cross_check.compare.expectations import ExpectationError, Rule, expect, rules
from cross_check.compare.verdicts import FULL_ONLY, Comparison, Side


def comparison(case: str = "impact/glass", left: str = "native[yade]", verdict: str = "agree") -> Comparison:
    return Comparison(
        case=case,
        level="L1",
        check="mirror",
        quantity="force_history",
        unit="N",
        left=Side(left, 1.0, None),
        right=Side("yade", 1.0, None),
        discrepancy=0.0,
        scale="peak",
        bound=1e-9,
        bound_source="rounding",
        verdict=verdict,
        expected="",
    )


RULE = Rule(case="impact/*", verdict="agree", count=1)


def test_a_rule_states_the_expectation_of_what_it_matches() -> None:
    (judged,) = expect([comparison()], [RULE], {"impact"}, complete=True)
    assert judged.expected == "agree"
    assert judged.as_expected


def test_a_verdict_other_than_the_expected_one_fails() -> None:
    (judged,) = expect([comparison(verdict="not-run(gone)")], [RULE], {"impact"}, complete=True)
    assert not judged.as_expected


def test_the_known_cause_stands_in_the_note_of_what_ends_as_expected() -> None:
    known = replace(RULE, verdict="differ", why="the plane is a large sphere", count=2)
    seen = [replace(comparison(verdict="differ"), note="seeds: 1"), comparison(verdict="agree")]
    first, second = expect(seen, [known], {"impact"}, complete=True)
    assert first.note == "seeds: 1\nthe plane is a large sphere"
    assert second.note == ""


def test_what_the_quick_form_leaves_out_is_expected_to_be_left_out_and_counted() -> None:
    (judged,) = expect([comparison(verdict=FULL_ONLY)], [RULE], {"impact"}, complete=True)
    assert judged.as_expected
    judged, missing = expect([comparison(verdict=FULL_ONLY)], [replace(RULE, count=2)], {"impact"}, complete=True)
    assert judged.as_expected
    assert not missing.as_expected


def test_a_comparison_without_a_rule_fails_where_its_case_has_rules() -> None:
    narrow = replace(RULE, case="impact/steel", count=0)
    (judged,) = expect([comparison()], [narrow], {"impact"}, complete=True)
    assert not judged.as_expected


def test_a_case_of_a_user_is_expected_to_agree() -> None:
    agreed, differs = expect([comparison("own"), comparison("own", verdict="differ")], [RULE], {"own"}, complete=True)
    assert agreed.as_expected
    assert not differs.as_expected


def test_a_comparison_that_vanishes_fails() -> None:
    (missing,) = expect([], [RULE], {"impact"}, complete=True)
    assert not missing.as_expected
    assert "impact/*" in missing.bound_source


def test_counts_do_not_matter_where_a_part_of_the_codes_runs() -> None:
    assert expect([], [RULE], {"impact"}, complete=False) == []


def test_brackets_of_mirror_names_are_letters() -> None:
    rule = replace(RULE, left="native[yade]")
    (judged,) = expect([comparison()], [rule], {"impact"}, complete=True)
    assert judged.as_expected


def test_a_table_with_an_unknown_key_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "table.toml"
    path.write_text('[[expect]]\ncase = "x"\nverdict = "agree"\ncount = 1\ncolour = "green"\n')
    with pytest.raises(ExpectationError, match=r"table\.toml.*colour"):
        rules(path)


def test_every_rule_of_the_package_says_something() -> None:
    table = rules()
    assert table
    assert all(rule.count > 0 for rule in table)
