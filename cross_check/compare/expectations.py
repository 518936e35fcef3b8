"""Expected verdicts: every comparison has one, and green is never the default."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from fnmatch import translate
from functools import cache
from pathlib import Path

from cross_check import PACKAGE, toml_file
from cross_check.compare.verdicts import AGREE, DIFFER, FULL_ONLY, Comparison, Side, kind, not_run


class ExpectationError(Exception):
    """A table of expected verdicts that cannot be read."""


@dataclass(frozen=True)
class Rule:
    """Comparisons that match every given pattern (`*` and `?`) are expected to end in `verdict`.

    `count` is the number of comparisons that the rule must cover: one that vanishes is as wrong as one that turns red.
    `why` is what is known of the cause; it stands in the notes of the comparisons that end as expected.
    """

    case: str
    verdict: str
    count: int
    check: str = "*"
    quantity: str = "*"
    left: str = "*"
    right: str = "*"
    why: str = ""

    def matches(self, item: Comparison) -> bool:
        """Whether the rule speaks of this comparison."""
        pairs = (
            (self.case, item.case),
            (self.check, item.check),
            (self.quantity, item.quantity),
            (self.left, item.left.source),
            (self.right, item.right.source),
        )
        return all(pattern == "*" or _expression(pattern).match(value) for pattern, value in pairs)


@cache
def _expression(pattern: str) -> re.Pattern[str]:
    """A pattern as it is matched, made once: brackets of `native[x]` are letters here, not character sets."""
    return re.compile(translate(pattern.replace("[", "[[]")))


def rules(path: Path = PACKAGE / "expected_verdicts.toml") -> list[Rule]:
    """The rules of a table, in order. Raises ExpectationError."""
    try:
        return [Rule(**entry) for entry in toml_file.read(path)["expect"]]
    except (toml_file.TomlError, KeyError, TypeError) as error:
        names = ", ".join(field.name for field in fields(Rule))
        raise ExpectationError(f"{path}: {error} (a rule has the keys {names})") from error


def expect(comparisons: Iterable[Comparison], table: list[Rule], cases: set[str], complete: bool) -> list[Comparison]:
    """The comparisons with their expected verdicts; the first rule that matches speaks.

    `cases` are the names of the cases that ran. A case for which the table holds no rule (a user's own) is expected to
    agree, or to differ by a known difference, which its mirror proves in the same run. With
    `complete`, a rule that covers another number of comparisons than its count adds a failing comparison.
    """
    governed = {case for case in cases if any(_case(rule) == case for rule in table)}
    covered = [0] * len(table)
    judged: list[Comparison] = []
    by_case: dict[str, list[int]] = {}
    for item in comparisons:
        if item.case not in by_case:
            by_case[item.case] = [i for i, rule in enumerate(table) if _expression(rule.case).match(item.case)]
        index = next((i for i in by_case[item.case] if table[i].matches(item)), None)
        if index is not None:
            covered[index] += 1
            judged.append(_governed(item, table[index]))
        elif item.case.partition("/")[0] in governed:
            judged.append(replace(item, expected="(no rule in expected_verdicts.toml)"))
        else:
            known = kind(item.verdict) == "known-difference"
            judged.append(replace(item, expected=item.verdict if known else AGREE))
    # What the quick form leaves out is expected to be left out; the full form runs it and the rule speaks.
    judged = [replace(item, expected=FULL_ONLY) if item.verdict == FULL_ONLY else item for item in judged]
    if complete:
        judged += [
            _miscounted(rule, n)
            for rule, n in zip(table, covered, strict=True)
            if _case(rule) in cases and n != rule.count
        ]
    return judged


def _governed(item: Comparison, rule: Rule) -> Comparison:
    known = rule.why if item.verdict == rule.verdict else ""
    return replace(item, expected=rule.verdict, note="\n".join(part for part in (item.note, known) if part))


def _case(rule: Rule) -> str:
    return rule.case.partition("/")[0].rstrip("*") or rule.case


def _miscounted(rule: Rule, count: int) -> Comparison:
    return Comparison(
        case=_case(rule),
        level="-",
        check="expectation",
        quantity="number of comparisons",
        unit="-",
        left=Side("comparisons", float(count), 0.0),
        right=Side("expected_verdicts.toml", float(rule.count), 0.0),
        discrepancy=abs(float(count - rule.count)),
        scale="absolute",
        bound=0.0,
        bound_source=f"rule {rule.case}, {rule.check}, {rule.quantity}, {rule.left} vs {rule.right}: {rule.verdict}",
        verdict=DIFFER if count else not_run("no comparison matches the rule"),
        expected=AGREE,
    )
