"""Deck text: only validated numbers and fixed words get in, and templates place them without arithmetic."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from cross_check.adapters.interface import InvalidScene, Row

_WORD = re.compile(r"[A-Za-z0-9._=/,+-]+")


def number(value: float) -> str:
    """`value` with 17 digits, which every code reads back to the same bits."""
    if not math.isfinite(value):
        raise InvalidScene(f"{value!r} cannot be written into a deck: every number must be finite")
    return f"{value:.17g}"


def numbers(values: Sequence[float]) -> str:
    """`values` with 17 digits, separated by blanks."""
    return " ".join(number(value) for value in values)


def word(text: str) -> str:
    """`text` unchanged if it is safe to print in a deck: letters, digits and . _ = / + - only."""
    if not _WORD.fullmatch(text):
        raise InvalidScene(f"the name {text!r} cannot be written into a deck: letters, digits and ._=/,+- are allowed")
    return text


def table(rows: Sequence[Row]) -> list[str]:
    """The translation as aligned lines of text, the first one naming the columns."""
    cells = [("case key", "value", "deck key", "value", "unit", "formula")]
    for row in rows:
        cells.append((row.case_key, row.case_value, row.code_key, row.code_value, row.unit, row.formula))
    widths = [max(len(line[column]) for line in cells) for column in range(6)]
    return [" | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in cells]


def render(template: Path, values: dict[str, object]) -> str:
    """Fills `template`; a value that the template names and `values` lacks is an error."""
    return _environment(template.parent).get_template(template.name).render(values)


@cache
def _environment(folder: Path) -> Environment:
    """The templates of `folder`, compiled once per process."""
    return Environment(
        loader=FileSystemLoader(folder),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # noqa: S701  decks are no HTML; what enters them is validated
    )
