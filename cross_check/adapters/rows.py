"""Rows of numbers as text, read at the speed of C and refused as a whole where one is not what it should be."""

from __future__ import annotations

import warnings

import numpy as np

from cross_check.record import Array


def number_rows(lines: list[bytes], width: int) -> Array | None:
    """The numbers of rows of `width` values, shape (rows, width), or None if a row is not such a row or not finite."""
    if not lines:
        return np.empty((0, width))
    if {line.rstrip().count(b" ") for line in lines} != {width - 1}:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            values = np.fromstring(b" ".join(lines), dtype=np.float64, sep=" ")
        except (ValueError, DeprecationWarning):
            return None
    if values.size != width * len(lines) or not np.all(np.isfinite(values)):
        return None
    table: Array = np.reshape(values, (len(lines), width))
    return table
