"""Vectors of a scene."""

from __future__ import annotations

from collections.abc import Sequence

Vector = tuple[float, float, float]


def vector(raw: Sequence[float]) -> Vector:
    """Three numbers as a vector."""
    x, y, z = raw
    return (float(x), float(y), float(z))
