"""Verdicts: what a comparison concluded, beside what was expected of it."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

AGREE = "agree"
DIFFER = "differ"
INCONCLUSIVE = "inconclusive"
KINDS = (AGREE, DIFFER, INCONCLUSIVE, "known-difference", "not-comparable", "not-run")


def known_difference(identifier: str) -> str:
    """The verdict for a difference that is predicted and listed in known_differences.toml."""
    return f"known-difference({identifier})"


def not_comparable(reason: str) -> str:
    """The verdict for a code that has no form for what the case asks."""
    return f"not-comparable({reason})"


def not_run(reason: str) -> str:
    """The verdict for a run that did not deliver a record."""
    return f"not-run({reason})"


# The verdict for what the quick form of a suite leaves to the full one.
FULL_ONLY = not_run("full only")


def kind(verdict: str) -> str:
    """The verdict without its reason: one of KINDS."""
    return verdict.partition("(")[0]


@dataclass(frozen=True)
class Side:
    """One side of a comparison. `value` is None where there is none; `uncertainty` is in the same unit.

    `uncertainty_kind` says where the uncertainty comes from (`time step`, `rounding`, `closed form`, `none`).
    `recorded` is true where a stored run stands in for a live one.
    """

    source: str
    value: float | None
    uncertainty: float | None
    uncertainty_kind: str = "none"
    recorded: bool = False


@dataclass(frozen=True)
class Comparison:
    """One line of verdicts.json.

    `case` names the scene (`case/variant`). For a series (`force_history` ...) the two values are the
    peaks and the discrepancy is the largest difference over the common steps divided by `scale`.
    """

    case: str
    level: str
    check: str
    quantity: str
    unit: str
    left: Side
    right: Side
    discrepancy: float | None
    scale: str
    bound: float | None
    bound_source: str
    verdict: str
    expected: str
    note: str = ""

    @property
    def as_expected(self) -> bool:
        """Whether the verdict is the one that expected_verdicts.toml states."""
        return self.verdict == self.expected

    def to_dict(self) -> dict[str, Any]:
        """The JSON form."""
        return asdict(self) | {"as_expected": self.as_expected}
