"""Observables of contacts along prescribed paths."""

from __future__ import annotations

from cross_check.compare.quantity import Quantity
from cross_check.record import Array, RunRecord
from cross_check.scene import Scene


def torque_history(_: Scene, record: RunRecord) -> Array:
    """Contact torque on every particle, shape (T, N, 3) [N m]."""
    return record["torque"]


QUANTITIES = (Quantity("torque_history", "N m", series=torque_history),)
