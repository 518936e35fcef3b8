"""How numbers and names are written in pages, tables and file names."""

from __future__ import annotations

import hashlib
import math
import re

ABSENT = "\N{EN DASH}"


def _trim(text: str) -> str:
    """`3.0e-09` as `3e-9`."""
    mantissa, mark, exponent = text.partition("e")
    if not mark:
        return text
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}e{int(exponent)}"


def number(value: float | None, digits: int = 10) -> str:
    """A number with up to `digits` significant digits; never hides what is not a finite number."""
    if value is None:
        return ABSENT
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "infinite" if value > 0 else "-infinite"
    return _trim(f"{value:.{digits}g}")


def short(value: float | None) -> str:
    """A number for a narrow cell: two digits."""
    if value is None or not math.isfinite(value) or value == 0:
        return number(value)
    return number(value, 2) if 1e-2 <= abs(value) < 1e4 else _trim(f"{value:.1e}")


def is_bad(*values: float | None) -> bool:
    """Whether one of the values is there but is not a finite number."""
    return any(value is not None and not math.isfinite(value) for value in values)


def span(seconds: float) -> str:
    """A duration [s] as people say it."""
    if not math.isfinite(seconds):
        return number(seconds)
    if seconds < 1:
        return f"{number(seconds * 1e3, 3)} ms"
    if seconds < 60:
        return f"{number(seconds, 3)} s"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"


def slug(text: str) -> str:
    """A name for files and anchors: a to z, digits, dots and dashes. A name that had to change gets a short hash."""
    plain = re.sub(r"[^a-z0-9.]+", "-", text.lower()).strip("-.").replace("..", ".")
    if plain == text:
        return plain
    digest = hashlib.blake2b(text.encode(), digest_size=3).hexdigest()
    return f"{plain[:60]}-{digest}" if plain else digest
