"""`verdicts.json`: the comparisons as a file, strict JSON, written and read back without loss."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from cross_check.compare.verdicts import Comparison, Side

NAMES = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
NUMBERS = ("value", "uncertainty", "discrepancy", "bound")


def write(path: Path, comparisons: list[Comparison]) -> None:
    """Writes all comparisons. JSON has no NaN: what is not a finite number becomes one of the texts in NAMES."""
    lines = [_named(comparison.to_dict()) for comparison in comparisons]
    path.write_text(json.dumps(lines, indent=1, allow_nan=False, ensure_ascii=False) + "\n", encoding="utf-8")


def read(path: Path) -> list[Comparison]:
    """Reads what `write` wrote."""
    return [_comparison(raw) for raw in json.loads(path.read_text(encoding="utf-8"))]


def _named(raw: dict[str, Any]) -> dict[str, Any]:
    out: dict[str, Any] = {}
    for key, value in raw.items():
        if isinstance(value, dict):
            out[key] = _named(value)  # pyright: ignore[reportUnknownArgumentType]
        elif isinstance(value, float) and not math.isfinite(value):
            out[key] = "NaN" if math.isnan(value) else ("Infinity" if value > 0 else "-Infinity")
        else:
            out[key] = value
    return out


def _numbered(raw: dict[str, Any]) -> dict[str, Any]:
    return {key: NAMES.get(value, value) if key in NUMBERS else value for key, value in raw.items()}


def _comparison(raw: dict[str, Any]) -> Comparison:
    fields = _numbered(raw)
    fields.pop("as_expected", None)  # follows from verdict and expected
    fields["left"], fields["right"] = Side(**_numbered(raw["left"])), Side(**_numbered(raw["right"]))
    return Comparison(**fields)
