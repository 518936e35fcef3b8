"""Rolling and twisting moments of LIGGGHTS, YADE and LAMMPS re-stated from their formulas."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from cross_check.contact_model import ConstantTorque, ElasticPlasticRolling
from cross_check.scene import Scene

from .restated_contact import Array, Contact, Memory, Stiffness, flattened, length, turned

NONE = np.zeros(3)


def liggghts_moment(scene: Scene, contact: Contact, law: Stiffness, memory: Memory) -> Array:
    """cdt and epsd*: at a wall the spin is stretched by (R - d/2) / (R - d); the memory is not turned."""
    moments, pair = scene.model.moments, contact.pair
    if moments.law == "free":
        return NONE
    spin = contact.spins[0] - contact.spins[1]
    if contact.wall:
        spin = contact.spins[0] * (contact.radii[0] - contact.overlap / 2) / (contact.radii[0] - contact.overlap)
    across = spin - contact.normal * float(spin @ contact.normal)
    radius, friction = contact.reduced_radius, pair.rolling_friction or 0.0
    if isinstance(moments, ConstantTorque):
        size = friction * law.elastic * radius / length(spin)
        return -size * (spin if moments.torsion else across)
    assert isinstance(moments, ElasticPlasticRolling)
    rate = spin if moments.twisting.kind == "joint" else across
    if moments.stiffness.kind == "tangential":
        spring = law.shear * radius**2
    else:
        secant = law.elastic / contact.overlap
        spring = (moments.stiffness.value or 0.0) * secant * friction**2 * radius**2
    memory.rolling = memory.rolling - spring * scene.time_step * rate
    limit = abs(law.seen) * radius * friction
    if length(memory.rolling) > limit:
        memory.rolling = memory.rolling * (limit / length(memory.rolling))
        return memory.rolling
    inertias = [mass * size**2 for mass, size in zip(contact.masses, contact.radii, strict=True)]
    inertia = 1.4 * (inertias[0] if contact.wall else inertias[0] * inertias[1] / sum(inertias))
    return memory.rolling - (moments.dashpot.value or 0.0) * 2 * math.sqrt(inertia * spring) * rate


def yade_moment(scene: Scene, contact: Contact, law: Stiffness, memory: Memory) -> Array:
    """Two moments that turn with the contact; the bending one is capped, unless eta is zero."""
    moments, dt = scene.model.moments, scene.time_step
    if not isinstance(moments, ElasticPlasticRolling):
        return NONE
    spin = contact.spins[0] - contact.spins[1]
    about = contact.normal * float(spin @ contact.normal)
    value = moments.stiffness.value or 0.0
    spring = value if moments.stiffness.kind == "constant" else value * contact.reduced_radius**2
    memory.rolling = turned(memory, memory.rolling, contact, dt) - spring * dt * (spin - about)
    memory.twist = turned(memory, memory.twist, contact, dt) - (moments.twisting.stiffness or 0.0) * dt * about
    limit = (contact.pair.rolling_friction or 0.0) * contact.reduced_radius * abs(law.force)
    if moments.limit != "unlimited" and limit > 0 and length(memory.rolling) > limit:
        memory.rolling = memory.rolling * (limit / length(memory.rolling))
    return memory.rolling + memory.twist


def lammps_moment(scene: Scene, contact: Contact, law: Stiffness, memory: Memory) -> Array:
    """A rolling displacement with a force at R*, and a twist whose capped moment opposes the spin."""
    moments, pair, dt = scene.model.moments, contact.pair, scene.time_step
    if not isinstance(moments, ElasticPlasticRolling):
        return NONE
    spin, radius = contact.spins[0] - contact.spins[1], contact.reduced_radius
    value = moments.stiffness.value or 0.0
    spring = value / radius**2 if moments.stiffness.kind == "constant" else value
    dashpot = moments.dashpot.value or 0.0
    rate = radius * np.cross(spin, contact.normal)
    limit = (pair.rolling_friction or 0.0) * abs(law.seen)
    memory.rolling = flattened(memory.rolling, contact.normal, 1e-10 * limit / spring) + rate * dt
    force = -spring * memory.rolling - dashpot * rate
    if length(force) > limit:
        force = force * (limit / length(force))
        memory.rolling = -(force + dashpot * rate) / spring
    return radius * np.cross(contact.normal, force) + lammps_twist(moments, contact, law, memory, dt) * contact.normal


def lammps_twist(moments: ElasticPlasticRolling, contact: Contact, law: Stiffness, memory: Memory, dt: float) -> float:
    """Twisting moment about the normal [N m]."""
    twisting = moments.twisting
    if twisting.kind == "none":
        return 0.0
    rate = float((contact.spins[0] - contact.spins[1]) @ contact.normal)
    friction = (contact.pair.twisting_friction or 0.0) * abs(law.seen)
    if twisting.kind == "spot":
        spring, dashpot = 0.5 * law.shear * contact.spot**2, 0.5 * law.dashpot * contact.spot**2
        limit = 2 / 3 * contact.spot * friction
    else:
        spring, dashpot = twisting.stiffness or 0.0, twisting.dashpot or 0.0
        limit = (twisting.arm or 0.0) * friction
    memory.angle += rate * dt
    moment = -spring * memory.angle - dashpot * rate
    if abs(moment) > limit:
        sign = math.copysign(1.0, rate)
        memory.angle = (limit * sign - dashpot * rate) / spring
        return -limit * sign
    return moment


MOMENTS: dict[str, Callable[[Scene, Contact, Stiffness, Memory], Array]] = {
    "liggghts": liggghts_moment,
    "yade": yade_moment,
    "lammps": lammps_moment,
}
