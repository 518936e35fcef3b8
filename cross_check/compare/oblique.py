"""Observables of oblique impacts: what is left of the slip, spins, and what conservation says of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cross_check.compare.quantity import Quantity, Undefined, impact
from cross_check.geometry import facing
from cross_check.mirror_options import Arms
from cross_check.record import Array, RunRecord
from cross_check.scene import Scene

# Arms of the plain native law: to the middle of the overlap.
PLAIN_ARMS = Arms("mid_overlap", "mid_overlap")


@dataclass(frozen=True)
class Frame:
    """The plane of motion of an impact of two bodies and the velocities in it, shape (T,).

    `along` and `surface` [m/s] are the relative velocity of the centres and of the contact points along the slip at the
    start, `away` [m/s] is that of the centres along the normal at the start, `spin` [rad/s] that of the first sphere
    about normal x slip. `friction` [-] is the coefficient of the pair.
    """

    along: Array
    surface: Array
    away: Array
    spin: Array
    friction: float


def frame(scene: Scene, record: RunRecord) -> Frame:
    """The frame of an impact that begins and ends in free flight. Raises Undefined for others."""
    found = impact(scene, record)
    if found.overlap[0] > 0.0 or found.overlap[-1] > 0.0:
        raise Undefined("the bodies touch at the first or last sample")
    if not np.any(found.overlap > 0.0):
        raise Undefined("the bodies never touch")
    first = scene.particles[0]
    velocity, spins = record.synchronized_velocity(), _spins(scene, record)
    relative, rolled = velocity[:, 0], first.radius * spins[:, 0]
    if len(scene.particles) == 2:
        other = scene.particles[1]
        partner = other.material
        branch = record["position"][0, 0] - record["position"][0, 1]
        normal = branch / np.linalg.norm(branch)
        relative, rolled = relative - velocity[:, 1], rolled + other.radius * spins[:, 1]
    else:
        body = scene.bodies[0]
        partner, normal = body.material, facing(body.shape, record["position"][:1, 0])[0][0]
        relative = relative - np.array(body.motion.velocity or (0.0, 0.0, 0.0))
    surface = relative - np.cross(rolled, normal)
    slip = surface[0] - float(surface[0] @ normal) * normal
    size = float(np.linalg.norm(slip))
    if size == 0.0:
        raise Undefined("the bodies do not slip at the start")
    tangent = slip / size
    pair = scene.pair(first.material, partner)
    if pair is None or pair.friction is None:
        raise Undefined("the pair of the impact has no coefficient of friction")
    axis = np.cross(normal, tangent)
    return Frame(relative @ tangent, surface @ tangent, relative @ normal, spins[:, 0] @ axis, pair.friction)


def _inertia(scene: Scene) -> Array:
    return np.array([particle.moment_of_inertia for particle in scene.particles])


def _spins(scene: Scene, record: RunRecord) -> Array:
    return record.synchronized_spin(_inertia(scene))


def tangential_velocity(scene: Scene, record: RunRecord) -> float:
    """Velocity of the centres along the slip at the start, after the impact [m/s]."""
    return float(frame(scene, record).along[-1])


def tangential_restitution(scene: Scene, record: RunRecord) -> float:
    """The same over that before the impact [-]."""
    found = frame(scene, record)
    if found.along[0] == 0.0:
        raise Undefined("the centres have no tangential velocity at the start")
    return float(found.along[-1] / found.along[0])


def rebound_spin(scene: Scene, record: RunRecord) -> float:
    """Spin of the first sphere about normal x slip after the impact [rad/s]."""
    return float(frame(scene, record).spin[-1])


def rebound_tangent(scene: Scene, record: RunRecord) -> float:
    """Velocity of the contact points over the normal velocity after the impact [-]."""
    found = frame(scene, record)
    return float(found.surface[-1] / found.away[-1])


def sliding_excess(scene: Scene, record: RunRecord) -> float:
    """Change of the tangential velocity over mu (1 + e) v_n, less 1 [-]: 0 where the whole impact slides at mu N.

    e is the restitution of the run itself.
    """
    found = frame(scene, record)
    expected = found.friction * float(found.away[-1] - found.away[0])
    return abs(float(found.along[-1] - found.along[0])) / expected - 1.0


def tangential_speed(scene: Scene, record: RunRecord) -> float:
    """Largest speed of any centre across the line of centres after the impact [m/s]."""
    normal = _normal(scene, record)
    velocity = record.synchronized_velocity()[-1]
    across = velocity - (velocity @ normal)[:, None] * normal
    return float(np.max(np.linalg.norm(across, axis=1)))


def spin_change(scene: Scene, record: RunRecord) -> float:
    """Largest change of any spin over the largest spin at the start [-]."""
    spins = _spins(scene, record)
    scale = float(np.max(np.linalg.norm(spins[0], axis=1)))
    if scale == 0.0:
        raise Undefined("nothing spins at the start")
    return float(np.max(np.linalg.norm(spins[-1] - spins[0], axis=1))) / scale


def _normal(scene: Scene, record: RunRecord) -> Array:
    impact(scene, record)
    if len(scene.particles) == 1:
        return facing(scene.bodies[0].shape, record["position"][:1, 0])[0][0]
    branch = record["position"][0, 0] - record["position"][0, 1]
    return branch / np.linalg.norm(branch)


def _arm(rule: str, radius: float, overlap: Array) -> Array:
    shares = {"mid_overlap": 0.5, "radius": 0.0, "surface": 1.0}
    return radius - shares[rule] * overlap


def spin_defect(scene: Scene, record: RunRecord) -> float:
    """Change of angular momentum less the impulse of the recorded force at the law's arm, over that impulse [-].

    It sums over the neighbouring steps that the record holds: all in a run, those around events in a stored one. For
    models without moments.
    """
    found = impact(scene, record)
    options = scene.mirror.tangential
    arms = PLAIN_ARMS
    if options is not None:
        arms = options.wall_arms if len(scene.particles) == 1 else options.pair_arms
    position, force, spin = record["position"], record["force"], record["angular_velocity"]
    if len(scene.particles) == 2:
        branch = position[:, 0] - position[:, 1]
        normal = branch / np.linalg.norm(branch, axis=1)[:, None]
    else:
        normal, _ = facing(scene.bodies[0].shape, position[:, 0])
    dt = record.header.time_step
    neighbours = np.diff(record.step) == 1
    inertia, defect, scale = _inertia(scene), 0.0, 0.0
    for index, particle in enumerate(scene.particles):
        side = 1.0 if index == 0 else -1.0
        arm = _arm(arms.torque, particle.radius, found.overlap)
        torque = -side * arm[:, None] * np.cross(normal, force[:, index])
        # Velocity Verlet kicks by half a step on both sides; half-step velocities take the whole later torque.
        staggered = record.header.velocity_time == "half_step"
        kick = torque[1:] if staggered else 0.5 * (torque[1:] + torque[:-1])
        off = inertia[index] * np.diff(spin[:, index], axis=0) - dt * kick
        defect = max(defect, float(np.linalg.norm(off[neighbours].sum(axis=0))))
        scale = max(scale, float(dt * np.linalg.norm(kick[neighbours], axis=1).sum()))
    if scale == 0.0:
        raise Undefined("no torque acts on neighbouring steps of the record")
    return defect / scale


def angular_momentum_drift(scene: Scene, record: RunRecord) -> float:
    """Largest change of the angular momentum of a free pair over the sum of its parts at the start [-]."""
    if len(scene.particles) != 2 or scene.bodies or any(scene.gravity):
        raise Undefined("not a free pair")
    mass = np.array(record.header.mass)[None, :, None]
    orbit = mass * np.cross(record["position"], record.synchronized_velocity())
    spin = _inertia(scene)[None, :, None] * _spins(scene, record)
    total = (orbit + spin).sum(axis=1)
    scale = float(np.linalg.norm(orbit[0], axis=1).sum() + np.linalg.norm(spin[0], axis=1).sum())
    if scale == 0.0 or not math.isfinite(scale):
        raise Undefined("the pair has no angular momentum at the start")
    return float(np.max(np.linalg.norm(total - total[0], axis=1))) / scale


def torque_history(_: Scene, record: RunRecord) -> Array:
    """Contact torque on every particle, shape (T, N, 3) [N m]."""
    return record["torque"]


QUANTITIES = (
    Quantity("tangential_velocity", "m/s", scalar=tangential_velocity),
    Quantity("tangential_restitution", "-", scalar=tangential_restitution),
    Quantity("rebound_spin", "rad/s", scalar=rebound_spin),
    Quantity("rebound_tangent", "-", scalar=rebound_tangent),
    Quantity("sliding_excess", "-", scalar=sliding_excess),
    Quantity("tangential_speed", "m/s", scalar=tangential_speed),
    Quantity("spin_change", "-", scalar=spin_change),
    Quantity("spin_defect", "-", scalar=spin_defect, of_law=True),
    Quantity("angular_momentum_drift", "-", scalar=angular_momentum_drift),
    Quantity("torque_history", "N m", series=torque_history),
)
