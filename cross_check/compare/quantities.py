"""Observables of a record: pure functions, the same for every code.

A scalar is a number with a unit; a series has shape (T, N, 3) and belongs to the sampled steps. Events between samples
(onset, end, peak) are interpolated.
"""

from __future__ import annotations

import numpy as np

from cross_check.compare import adhesion, oblique, path_quantities, rolling, snapshots
from cross_check.compare.quantity import Impact, Quantity, Undefined, impact
from cross_check.record import DISSIPATED, Array, RunRecord
from cross_check.scene import Scene

__all__ = ["QUANTITIES", "Impact", "Quantity", "Undefined", "impact"]


def _touching(found: Impact) -> tuple[int, int]:
    """First and last sample in contact; both neighbours are free."""
    inside = np.flatnonzero(found.overlap > 0.0)
    if len(inside) == 0:
        raise Undefined("the bodies never touch")
    first, last = int(inside[0]), int(inside[-1])
    if first == 0:
        raise Undefined("the bodies touch at the first sample")
    if last == len(found.overlap) - 1:
        raise Undefined("the bodies still touch at the last sample")
    return first, last


def peak_force(scene: Scene, record: RunRecord) -> float:
    """Largest normal force [N], on the parabola through the largest sample and its neighbours."""
    found = impact(scene, record)
    top = int(np.argmax(found.force))
    if top in (0, len(found.force) - 1):
        raise Undefined("the largest force is at the first or last sample")
    before, after = found.time[top] - found.time[top - 1], found.time[top + 1] - found.time[top]
    rise = float((found.force[top] - found.force[top - 1]) / before)
    fall = float((found.force[top + 1] - found.force[top]) / after)
    curvature = (fall - rise) / (before + after)
    slope = (rise * after + fall * before) / (before + after)
    return float(found.force[top]) - (0.25 * slope * slope / curvature if curvature < 0.0 else 0.0)


def contact_duration(scene: Scene, record: RunRecord) -> float:
    """Time from first touch to separation [s]: the flight is free on both sides, so both instants are exact."""
    found = impact(scene, record)
    first, last = _touching(found)
    begin, end = first - 1, last + 1
    onset = found.time[begin] - found.overlap[begin] / found.speed[begin]
    separation = found.time[end] - found.overlap[end] / found.speed[end]
    return float(separation - onset)


def restitution(scene: Scene, record: RunRecord) -> float:
    """Rebound over impact speed [-] of bodies that separated."""
    found = impact(scene, record)
    _touching(found)
    return float(-found.speed[-1] / found.speed[0])


def outgoing_speed_ratio(scene: Scene, record: RunRecord) -> float:
    """Relative normal speed at the end over that at the start [-], whether or not the bodies separated."""
    found = impact(scene, record)
    return float(abs(found.speed[-1]) / abs(found.speed[0]))


def energy_residual(scene: Scene, record: RunRecord) -> float:
    """Largest residual of the energy balance during contact over the energy that entered the contact [-]."""
    if "energy_kinetic" not in record.columns:
        raise Undefined("the record holds no energy ledger")
    stored = record["energy_kinetic"] + record["energy_elastic"] + record["energy_gravity"]
    balance = sum((record[name] for name in DISSIPATED), stored) - record["energy_body_work"]
    entered = float(record["energy_entered"][-1])
    if entered == 0.0:
        raise Undefined("no energy entered a contact")
    return float(np.max(np.abs(balance - balance[0])) / entered)


def force_history(scene: Scene, record: RunRecord) -> Array:
    """Contact force on every particle, shape (T, N, 3) [N]."""
    return record["force"]


def position_history(scene: Scene, record: RunRecord) -> Array:
    """Centres, shape (T, N, 3) [m]."""
    return record["position"]


QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        Quantity("peak_force", "N", scalar=peak_force),
        Quantity("contact_duration", "s", scalar=contact_duration),
        Quantity("restitution", "-", scalar=restitution),
        Quantity("outgoing_speed_ratio", "-", scalar=outgoing_speed_ratio),
        Quantity("energy_residual", "-", scalar=energy_residual),
        Quantity("force_history", "N", series=force_history),
        Quantity("position_history", "m", series=position_history),
        Quantity("trajectory", "s", series=position_history),
        *path_quantities.QUANTITIES,
        *oblique.QUANTITIES,
        *rolling.QUANTITIES,
        *adhesion.QUANTITIES,
        *snapshots.QUANTITIES,
    )
}
