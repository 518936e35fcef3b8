"""Observables of adhesive impacts: the largest attraction, and whether the bodies part."""

from __future__ import annotations

import numpy as np

from cross_check.compare.quantity import Quantity, Undefined, impact
from cross_check.record import RunRecord
from cross_check.scene import Scene


def largest_attraction(scene: Scene, record: RunRecord) -> float:
    """Size of the most attractive normal force at any sample [N]."""
    found = impact(scene, record)
    attraction = -float(np.min(found.force))
    if attraction <= 0.0:
        raise Undefined("the bodies never attract each other")
    return attraction


def separation(scene: Scene, record: RunRecord) -> float:
    """1 if the bodies touched and are apart at the end, 0 if they stick [-]."""
    found = impact(scene, record)
    if not np.any(found.overlap > 0.0):
        raise Undefined("the bodies never touch")
    return float(found.overlap[-1] <= 0.0)


QUANTITIES = (
    Quantity("largest_attraction", "N", scalar=largest_attraction),
    Quantity("separation", "-", scalar=separation),
)
