"""Which cases there are, and which of them a suite or a name means."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from cross_check import PACKAGE, toml_file
from cross_check.engine import Case, CaseError, Variant, load_case

FOLDER = PACKAGE / "cases"
SUITES = ("standard", "laws", "collisions", "snapshots", "bulk", "sintering", "fine-powders", "packed-beds")
# The suite that is a study of its own: its runs branch off from each other (cross_check/sintering).
STUDY = "sintering"


@dataclass(frozen=True)
class Listed:
    """A case of the package as its file names it; what it contains is not read."""

    path: Path
    name: str
    suites: tuple[str, ...]


def listed() -> list[Listed]:
    """All cases of the package, by name. Raises TomlError."""
    tables = ((path, toml_file.read(path)) for path in FOLDER.glob("*.toml"))
    found = [Listed(path, table["name"], tuple(table.get("suites", ()))) for path, table in tables]
    return sorted(found, key=lambda case: case.name)


def every_case() -> list[Case]:
    """All cases of the package, by name."""
    return [load_case(case.path) for case in listed()]


def named(name: str) -> Case:
    """The case of the package with this name. Raises CaseError."""
    (case,) = select(name)[1]
    return case


def with_seeds(case: Case, count: int) -> Case:
    """The case with the first `count` seeds of every ensemble."""
    kept: list[Variant] = []
    for variant in case.variants:
        members = [other for other in case.variants if other.name == variant.name]
        if variant in members[:count]:
            kept.append(variant)
    return replace(case, variants=tuple(kept))


def require_gates(cases: list[Case]) -> None:
    """Raises CaseError where no case states a gate: nothing would be compared."""
    if any(variant.gates for case in cases for variant in case.variants):
        return
    judged = f", and `cross-check run {STUDY}` judges it" if all(STUDY in case.suites for case in cases) else ""
    names = ", ".join(case.name for case in cases)
    raise CaseError(f"{names}: no gate is stated, there is nothing to compare; `crossgrain run` runs it alone{judged}")


def select(what: str) -> tuple[str, list[Case]]:
    """The suite's name and the cases that `what` means: a suite, the name of a case, or the path of a case file.

    Raises CaseError where it means nothing.
    """
    path = Path(what)
    if path.suffix == ".toml" or path.is_file():
        case = load_case(path)
        return case.name, [case]
    cases = listed()
    if what in SUITES:
        chosen = [load_case(case.path) for case in cases if what in case.suites]
        if not chosen:
            raise CaseError(f"the suite {what} has no cases in this version")
        return what, chosen
    found = [load_case(case.path) for case in cases if case.name == what]
    if not found:
        names = ", ".join(case.name for case in cases)
        raise CaseError(f"{what}: no such suite, case or file (suites: {', '.join(SUITES)}; cases: {names})")
    return what, found
