"""One colour, dash and marker per source, the same in every figure and on the page (Okabe and Ito's colours)."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

INK = "#24292f"
GRID = "#d9dde3"

SOURCES = ("native", "liggghts", "yade", "lammps", "reference")
LIGHT = {
    "native": "#0072b2",
    "liggghts": "#d55e00",
    "yade": "#008a64",
    "lammps": "#b8578c",
    "reference": "#5b6470",
    "other-1": "#a37000",
    "other-2": "#2f8fc4",
}
DARK = {
    "native": "#58b0ea",
    "liggghts": "#f5924e",
    "yade": "#36cb9f",
    "lammps": "#e79fc6",
    "reference": "#b6bfca",
    "other-1": "#e6b84a",
    "other-2": "#8ccbf0",
}
MARKERS = {"native": "o", "liggghts": "s", "yade": "^", "lammps": "D", "reference": "x", "other-1": "v", "other-2": "P"}

Dash = tuple[float, tuple[float, ...]] | str
SOLID: Dash = "-"
DASHED: Dash = (0.0, (4.0, 2.0))
DOTTED: Dash = (0.0, (1.0, 1.6))
DASH_DOT: Dash = (0.0, (6.0, 1.8, 1.2, 1.8))


@dataclass(frozen=True)
class Look:
    """How a source is drawn; `hue` is the key of LIGHT and DARK, `width` is in points."""

    hue: str
    dash: Dash
    marker: str
    width: float
    order: int

    @property
    def color(self) -> str:
        """The colour on paper."""
        return LIGHT[self.hue]


def _hue(code: str) -> str:
    if code in ("closed form", "reference"):
        return "reference"
    if code in LIGHT:
        return code
    return f"other-{1 + sum(code.encode()) % 2}"


def mirrored(source: str) -> str | None:
    """The code that a mirror `native[X]` reproduces, or None."""
    match = re.fullmatch(r"native\[(.+)\]", source)
    return match.group(1) if match else None


def rank(source: str) -> tuple[int, str]:
    """Order of the sources on the page: native, its mirrors, the codes, the reference last."""
    code = mirrored(source) or source
    hue = _hue(code)
    place = SOURCES.index(hue) if hue in SOURCES else len(SOURCES) - 2
    if mirrored(source):
        return (place, source)
    return (0 if source == "native" else 10 + place + (10 if hue == "reference" else 0), source)


def look(source: str) -> Look:
    """The look of one source, or of a difference `a - b`."""
    left, mark, right = source.replace("\N{MINUS SIGN}", "-").partition(" - ")
    if mark:
        return _difference(left.strip(), right.strip())
    code = mirrored(source)
    hue = _hue(code or source)
    marker = MARKERS[hue]
    if code:
        return Look(hue, DASHED, marker, 0.9, 4)
    if hue == "reference":
        return Look(hue, DASH_DOT, marker, 1.6, 2)
    return Look(hue, SOLID, marker, 2.2 if hue == "native" else 1.2, 1 if hue == "native" else 3)


def _difference(left: str, right: str) -> Look:
    """The hue is that of the external code in it; the dash says what it is compared with."""
    sides = [left, right]
    codes = [side for side in sides if not side.startswith("native") and _hue(side) != "reference"]
    main = codes[0] if codes else next((side for side in sides if _hue(side) != "reference"), left)
    other = right if main == left else left
    base = look(main)
    if mirrored(other):
        dash = DASHED
    elif _hue(other) == "reference":
        dash = DASH_DOT
    else:
        dash = SOLID if other == "native" else DOTTED
    return replace(base, dash=dash, width=1.0)
