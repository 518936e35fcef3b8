"""`junit.xml`: one test suite per case, one test case per comparison, for the pages of a CI server."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

from cross_check.compare.verdicts import Comparison, kind
from cross_check.report.campaign import Campaign, case_of
from cross_check.report.notation import number

SKIPPED = ("not-run", "not-comparable")
FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def write(path: Path, campaign: Campaign) -> None:
    """Writes the verdicts: a failure where a verdict is not the expected one, skipped where nothing was to be had."""
    suites: dict[str, list[Comparison]] = {}
    for comparison in campaign.comparisons:
        suites.setdefault(case_of(comparison.case), []).append(comparison)
    root = ElementTree.Element("testsuites", name=_clean(f"cross-check {campaign.suite}"))
    root.attrib.update(_counts(campaign.comparisons), time=number(campaign.duration, 6))
    for case, comparisons in suites.items():
        suite = ElementTree.SubElement(root, "testsuite", name=_clean(case), timestamp=_clean(campaign.started))
        suite.attrib.update(_counts(comparisons))
        names: set[str] = set()
        for comparison in comparisons:
            _test_case(suite, comparison, f"{campaign.suite}.{case}", names)
    ElementTree.indent(root)
    path.write_bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")


def _skips(comparison: Comparison) -> bool:
    return comparison.as_expected and kind(comparison.verdict) in SKIPPED


def _counts(comparisons: list[Comparison]) -> dict[str, str]:
    return {
        "tests": str(len(comparisons)),
        "failures": str(sum(not comparison.as_expected for comparison in comparisons)),
        "errors": "0",
        "skipped": str(sum(_skips(comparison) for comparison in comparisons)),
    }


def _test_case(suite: ElementTree.Element, comparison: Comparison, group: str, names: set[str]) -> None:
    left, right = comparison.left.source, comparison.right.source
    name = f"{comparison.case} {comparison.quantity} {left} vs {right}"
    if name in names:
        name = f"{name} ({comparison.check})"
    names.add(name)
    case = ElementTree.SubElement(suite, "testcase", name=_clean(name), classname=_clean(group))
    if not comparison.as_expected:
        message = f"{comparison.verdict}, expected {comparison.expected}"
        failure = ElementTree.SubElement(case, "failure", message=_clean(message), type=kind(comparison.verdict))
        failure.text = _clean(_evidence(comparison))
    elif _skips(comparison):
        ElementTree.SubElement(case, "skipped", message=_clean(comparison.verdict))


def _evidence(comparison: Comparison) -> str:
    unit = comparison.unit
    lines = [
        f"{side.source}: {number(side.value, 17)} {unit} (uncertainty {number(side.uncertainty, 3)} {unit})"
        for side in (comparison.left, comparison.right)
    ]
    lines.append(f"discrepancy: {number(comparison.discrepancy, 6)} of {comparison.scale}")
    lines.append(f"bound: {number(comparison.bound, 6)} ({comparison.bound_source})")
    if comparison.note:
        lines.append(f"note: {comparison.note}")
    return "\n".join(lines)


def _clean(text: str) -> str:
    """Text without the characters that XML forbids (logs of foreign codes may hold them)."""
    return FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)
