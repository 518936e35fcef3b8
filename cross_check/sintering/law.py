"""The law of sintering by itself, as the engine computes it: one driven contact, and the softening of its stiffness."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

import crossgrain
from cross_check.record import Array

Law = dict[str, Any]
"""The normal law of a scene, in SI."""

_engine: Any = crossgrain


def contact(law: Law, overlaps: Array, stiffness: Array) -> dict[str, Array]:
    """Force [N] and history of a cohesive contact that is driven along overlaps [m], with k1 [N/m] at each of them."""
    return _engine.sintering_contact(json.dumps(law), overlaps, stiffness, True)


def softening(law: Law, times: Array, temperatures: Array, relaxation_times: Array) -> Array:
    """k1(T,t) [N/m] at times [s]: at rest at the first temperature [K], then each holds over the step that ends there.

    The engine's step is exact where temperature and relaxation time [s] do not change, however long it is.
    """
    steps = np.diff(times, prepend=times[:1])
    found = _engine.sintering_stiffness(json.dumps(law), temperatures, relaxation_times, steps)
    return np.asarray(found, dtype=np.float64)
