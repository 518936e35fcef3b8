"""Which cases there are, and which of them a suite or a name means."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from cross_check import PACKAGE
from cross_check.engine import Case, CaseError, Variant, load_case

FOLDER = PACKAGE / "cases"
SUITES = ("standard", "laws", "collisions", "snapshots", "bulk", "sintering", "fine-powders", "packed-beds")
# The suite that is a study of its own: its runs branch off from each other (cross_check/sintering).
STUDY = "sintering"


def every_case() -> list[Case]:
    """All cases of the package, by name."""
    return sorted((load_case(path) for path in FOLDER.glob("*.toml")), key=lambda case: case.name)


def with_seeds(case: Case, count: int) -> Case:
    """The case with the first `count` seeds of every ensemble."""
    kept: list[Variant] = []
    for variant in case.variants:
        members = [other for other in case.variants if other.name == variant.name]
        if variant in members[:count]:
            kept.append(variant)
    return replace(case, variants=tuple(kept))


def select(what: str) -> tuple[str, list[Case]]:
    """The suite's name and the cases that `what` means: a suite, the name of a case, or the path of a case file.

    Raises CaseError where it means nothing.
    """
    path = Path(what)
    if path.suffix == ".toml" or path.is_file():
        case = load_case(path)
        return case.name, [case]
    cases = every_case()
    if what in SUITES:
        chosen = [case for case in cases if what in case.suites]
        if not chosen:
            raise CaseError(f"the suite {what} has no cases in this version")
        return what, chosen
    named = [case for case in cases if case.name == what]
    if not named:
        names = ", ".join(case.name for case in cases)
        raise CaseError(f"{what}: no such suite, case or file (suites: {', '.join(SUITES)}; cases: {names})")
    return what, named
