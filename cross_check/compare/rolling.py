"""Observables of a sphere that slides, rolls or spins on a plane under its weight."""

from __future__ import annotations

import numpy as np

from cross_check.compare.quantity import Quantity, Undefined
from cross_check.record import Array, RunRecord
from cross_check.scene import Plane, Scene

# The steady part of a decay that is measured, as shares of the run: the spring is loaded before, motion ends after.
STEADY = (0.4, 0.9)


def _plane(scene: Scene) -> Plane:
    """The only body of a scene with one sphere. Raises Undefined for other scenes."""
    shape = scene.bodies[0].shape if len(scene.particles) == len(scene.bodies) == 1 else None
    if not isinstance(shape, Plane):
        raise Undefined("not one sphere on one plane")
    return shape


def _spin(scene: Scene, record: RunRecord) -> Array:
    inertia = np.array([particle.moment_of_inertia for particle in scene.particles])
    return record.synchronized_spin(inertia)[:, 0]


def rolling_velocity(scene: Scene, record: RunRecord) -> float:
    """Speed of the centre along the plane at the end [m/s]."""
    normal = np.array(_plane(scene).normal)
    velocity = record.synchronized_velocity()[-1, 0]
    return float(np.linalg.norm(velocity - float(velocity @ normal) * normal))


def sliding_time(scene: Scene, record: RunRecord) -> float:
    """Time at which the slip along the launch vanishes [s].

    It lies on the line through the samples at which the slip has first fallen to a half and to a tenth: the last of the
    slip is held by spring and dashpot.
    """
    plane = _plane(scene)
    normal = np.array(plane.normal)
    velocity = record.synchronized_velocity()[:, 0]
    overlap = scene.particles[0].radius - (record["position"][:, 0] - np.array(plane.point)) @ normal
    arm = scene.particles[0].radius - 0.5 * np.maximum(overlap, 0.0)
    slip = velocity - np.cross(_spin(scene, record), normal) * arm[:, None]
    along = slip @ (velocity[0] / np.linalg.norm(velocity[0]))
    half, tenth = (np.flatnonzero(along <= share * along[0]) for share in (0.5, 0.1))
    if len(tenth) == 0 or half[0] == 0 or along[half[0]] <= along[tenth[0]]:
        raise Undefined("the sphere does not stop sliding")
    first, last, time = int(half[0]), int(tenth[0]), record["time"]
    share = along[last] / (along[first] - along[last])
    return float(time[last] + share * (time[last] - time[first]))


def _steady_rate(record: RunRecord, values: Array) -> float:
    """Rate of change over the steady part of the run."""
    first, last = (int(share * (len(values) - 1)) for share in STEADY)
    return float((values[last] - values[first]) / (record["time"][last] - record["time"][first]))


def rolling_deceleration(scene: Scene, record: RunRecord) -> float:
    """Deceleration of the centre along the plane in the steady part of the run [m/s2]."""
    _plane(scene)
    velocity = record.synchronized_velocity()[:, 0]
    return -_steady_rate(record, velocity @ (velocity[0] / np.linalg.norm(velocity[0])))


def twisting_deceleration(scene: Scene, record: RunRecord) -> float:
    """Rate at which the spin about the normal falls in the steady part of the run [rad/s2]."""
    spin = _spin(scene, record) @ np.array(_plane(scene).normal)
    if spin[0] == 0.0:
        raise Undefined("the sphere does not spin about the normal")
    return -_steady_rate(record, spin * np.sign(spin[0]))


QUANTITIES = (
    Quantity("rolling_velocity", "m/s", scalar=rolling_velocity),
    Quantity("sliding_time", "s", scalar=sliding_time),
    Quantity("rolling_deceleration", "m/s2", scalar=rolling_deceleration),
    Quantity("twisting_deceleration", "rad/s2", scalar=twisting_deceleration),
)
