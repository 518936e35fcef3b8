"""Thins curves for drawing: few points, but every extreme that the eye would miss."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cross_check.record import Array
from cross_check.report.campaign import Curve

MOST_POINTS = 400
MOST_DIFFERENCES = 240  # of a difference: mostly noise, of which only the envelope can be seen


@dataclass(frozen=True)
class Drawn:
    """A curve ready to draw: `x`, `y` of shape (P,); what the drawing cannot show is counted."""

    source: str
    x: Array
    y: Array
    recorded: bool
    peak: float
    not_finite: int
    total: int

    @property
    def note(self) -> str:
        """A sentence on values that no line can show; empty where all are finite."""
        if not self.not_finite:
            return ""
        return f"{self.source}: {self.not_finite} of {self.total} values are not finite numbers (NaN)"


def _kept(x: Array, y: Array, limit: int) -> NDArray[np.int64]:
    """Indices of lowest and highest value of each of equal bins, both ends, the ends in x and one NaN per bin."""
    broken = ~np.isfinite(y)
    bins = max((limit - 4) // (3 if broken.any() else 2), 1)
    width = -(-len(y) // bins)
    low, high = np.where(broken, np.inf, y), np.where(broken, -np.inf, y)
    keep: list[NDArray[np.int64]] = [
        np.array([0, len(y) - 1], dtype=np.int64),
        _highest_per_bin(np.where(np.isfinite(x), -x, -np.inf), len(x)),
        _highest_per_bin(np.where(np.isfinite(x), x, -np.inf), len(x)),
        _highest_per_bin(-low, width),
        _highest_per_bin(high, width),
    ]
    if broken.any():
        first = _highest_per_bin(broken.astype(np.float64), width)
        keep.append(first[broken[first]])
    return np.unique(np.concatenate(keep))


def _highest_per_bin(values: Array, width: int) -> NDArray[np.int64]:
    """Index of the (first) highest value of every `width` neighbours."""
    filler: Array = np.full(-len(values) % width, -np.inf)
    bins = np.split(np.concatenate([values, filler]), (len(values) + len(filler)) // width)
    return np.array([place * width + int(np.argmax(part)) for place, part in enumerate(bins)], dtype=np.int64)


def thin(curve: Curve, *, scale: float = 1.0, absolute: bool = False, limit: int = MOST_POINTS) -> Drawn:
    """At most `limit` points of a curve, its values divided by `scale` [unit of y] and made absolute if asked."""
    x, y = np.asarray(curve.x, dtype=np.float64), np.asarray(curve.y, dtype=np.float64)
    if x.shape != y.shape or x.ndim != 1:
        raise ValueError(f"curve {curve.source}: x has shape {x.shape}, y {y.shape}, both must be one column")
    with np.errstate(all="ignore"):
        y = y / scale
    y = np.abs(y) if absolute else y
    finite = np.isfinite(x) & np.isfinite(y)
    y = np.where(finite, y, np.nan)
    peak = float(np.max(np.abs(y[finite]))) if finite.any() else float("nan")
    if len(y) > limit:
        index = _kept(x, y, limit)
        x_kept, y_kept = x[index], y[index]
    else:
        x_kept, y_kept = x, y
    return Drawn(curve.source, x_kept, y_kept, curve.recorded, peak, int(np.sum(~finite)), len(finite))
