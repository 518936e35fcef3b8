"""Forces and torques on every particle of one state: at the first sample, and after the steps that follow it.

Both are one sample of a record. A series has a row for every sample, so the sample stands in all of them.
"""

from __future__ import annotations

import numpy as np

from cross_check.compare.quantity import Quantity
from cross_check.record import Array, RunRecord
from cross_check.scene import Scene


def _sample(record: RunRecord, column: str, at: int) -> Array:
    values = record[column]
    return np.broadcast_to(values[at], values.shape)


def snapshot_force(scene: Scene, record: RunRecord) -> Array:
    """Contact force on every particle at the first sample, shape (T, N, 3) [N]."""
    return _sample(record, "force", 0)


def snapshot_torque(scene: Scene, record: RunRecord) -> Array:
    """Contact torque on every particle at the first sample, shape (T, N, 3) [N m]."""
    return _sample(record, "torque", 0)


def prelude_force(scene: Scene, record: RunRecord) -> Array:
    """Contact force on every particle at the last sample, shape (T, N, 3) [N]."""
    return _sample(record, "force", -1)


def prelude_torque(scene: Scene, record: RunRecord) -> Array:
    """Contact torque on every particle at the last sample, shape (T, N, 3) [N m]."""
    return _sample(record, "torque", -1)


QUANTITIES = (
    Quantity("snapshot_force", "N", series=snapshot_force),
    Quantity("snapshot_torque", "N m", series=snapshot_torque),
    Quantity("prelude_force", "N", series=prelude_force),
    Quantity("prelude_torque", "N m", series=prelude_torque),
)
