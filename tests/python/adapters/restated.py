"""The contacts of LIGGGHTS, YADE and LAMMPS re-stated from their formulas, without a look at the adapters.

Kick and drift: forces of step n see x(n) and v(n - 1/2). The normal points from j (a particle or a plane) to i.
"""

from __future__ import annotations

import math

import numpy as np

from cross_check.contact_model import Mindlin
from cross_check.scene import Scene

from .restated_contact import Array, Contact, Memory, Stiffness, flattened, length, turned
from .restated_moments import MOMENTS
from .restated_normal import stiffness


def liggghts_shear(contact: Contact, law: Stiffness, limit: float, memory: Memory, dt: float) -> Array:
    """A displacement that grows, then is projected; a capped spring loses its dashpot."""
    slip = contact.slip("half")
    grown = memory.shear + slip * dt
    memory.shear = grown - contact.normal * float(grown @ contact.normal)
    force = -law.shear * memory.shear
    if length(force) > limit:
        force = force * (limit / length(force))
        memory.shear = -force / law.shear
        return force
    return force - law.dashpot * slip


def yade_shear(contact: Contact, law: Stiffness, limit: float, memory: Memory, dt: float) -> Array:
    """A force that turns, then grows; a capped spring loses its dashpot."""
    slip = contact.slip("plane" if contact.wall else "half")
    memory.shear = turned(memory, memory.shear, contact, dt) - law.shear * dt * slip
    if length(memory.shear) > limit:
        memory.shear = memory.shear * (limit / length(memory.shear))
        return memory.shear
    return memory.shear - law.dashpot * slip


def lammps_shear(contact: Contact, law: Stiffness, limit: float, memory: Memory, dt: float, history: str) -> Array:
    """A displacement (or force) that turns, then grows; the cap holds spring and dashpot together."""
    slip, force = contact.slip("full"), history.startswith("force")
    if history == "force_rescaled" and contact.spot < memory.spot:
        memory.shear = memory.shear * (contact.spot / memory.spot)
    memory.spot = contact.spot
    scale = 1.0 if force else law.shear
    kept = flattened(memory.shear, contact.normal, 1e-10 * limit / scale)
    memory.shear = kept - law.shear * dt * slip if force else kept + slip * dt
    total = (memory.shear if force else -law.shear * memory.shear) - law.dashpot * slip
    if length(total) > limit:
        total = total * (limit / length(total))
        spring = total + law.dashpot * slip
        memory.shear = spring if force else -spring / law.shear
    return total


def shear_force(scene: Scene, code: str, contact: Contact, law: Stiffness, memory: Memory) -> Array:
    """Tangential force on i [N]."""
    if scene.model.tangential.law == "frictionless":
        return np.zeros(3)
    limit = (contact.pair.friction or 0.0) * abs(law.seen)
    if code == "liggghts":
        return liggghts_shear(contact, law, limit, memory, scene.time_step)
    if code == "yade":
        return yade_shear(contact, law, limit, memory, scene.time_step)
    tangential = scene.model.tangential
    history = tangential.history if isinstance(tangential, Mindlin) else "displacement"
    return lammps_shear(contact, law, limit, memory, scene.time_step, history)


def torque_arms(code: str, contact: Contact) -> tuple[float, float]:
    """Arms of the tangential force [m]."""
    if contact.wall and code != "liggghts":
        return contact.arms("plane" if code == "yade" else "full")
    return contact.arms("half")


def contacts(scene: Scene, code: str, x: Array, v: Array, w: Array) -> list[tuple[int, int | None, Contact]]:
    """Every contact: index of i, index of j or None at a plane, kinematics. Key of the memory: order of this list."""
    found: list[tuple[int, int | None, Contact]] = []
    items = scene.particles
    for i, one in enumerate(items):
        for j, other in enumerate(items[:i]):
            between = x[i] - x[j]
            distance = length(between)
            pair = scene.pair(one.material, other.material)
            assert pair is not None
            radii, masses = (one.radius, other.radius), (one.mass, other.mass)
            reduced = [a * b / (a + b) for a, b in (radii, masses)]
            overlap = sum(radii) - distance
            spins = (w[i], w[j])
            contact = Contact(
                pair, between / distance, overlap, radii, reduced[0], reduced[1], v[i] - v[j], spins, False, masses
            )
            found.append((i, j, contact))
        for body in scene.bodies:
            pair = scene.pair(one.material, body.material)
            assert pair is not None
            normal, point = np.array(body.shape.normal), np.array(body.shape.point)
            overlap = one.radius - float((x[i] - point) @ normal)
            velocity = v[i] - np.array(body.motion.velocity or (0.0, 0.0, 0.0))
            radius = one.radius * 1e8 / (1 + 1e8) if code == "yade" else one.radius
            radii, masses = (one.radius, 1e8 * one.radius), (one.mass, math.inf)
            spins = (w[i], np.zeros(3))
            contact = Contact(pair, normal, overlap, radii, radius, one.mass, velocity, spins, True, masses)
            found.append((i, None, contact))
    return found


def integrate(scene: Scene, code: str, cut: bool) -> tuple[Array, Array, Array]:
    """Positions [m], contact forces [N] and torques [N m] at every step, shape (steps + 1, N, 3)."""
    dt, gravity = scene.time_step, np.array(scene.gravity)
    x = np.array([p.position for p in scene.particles])
    v = np.array([p.velocity for p in scene.particles]) - 0.5 * dt * gravity
    w = np.array([p.angular_velocity for p in scene.particles])
    mass = np.array([[p.mass] for p in scene.particles])
    inertia = np.array([[p.moment_of_inertia] for p in scene.particles])
    places, forces, torques = (np.zeros((scene.steps + 1, *x.shape)) for _ in range(3))
    memories: dict[tuple[int, int], Memory] = {}
    for n in range(scene.steps + 1):
        f, t = forces[n], torques[n]
        places[n] = x
        for place, (i, j, contact) in enumerate(contacts(scene, code, x, v, w)):
            if contact.overlap <= 0:
                memories.pop((i, place), None)
                continue
            memory = memories.setdefault((i, place), Memory())
            force, moment_i, moment_j = act(scene, code, contact, memory, cut)
            f[i] += force
            t[i] += moment_i
            if j is not None:
                f[j] -= force
                t[j] += moment_j
        v = v + dt * (f / mass + gravity)
        w = w + dt * t / inertia
        x = x + dt * v
    return places, forces, torques


def act(scene: Scene, code: str, contact: Contact, memory: Memory, cut: bool) -> tuple[Array, Array, Array]:
    """Force on i [N], torques on i and j [N m]."""
    law = stiffness(scene, code, contact, memory, cut)
    shear = shear_force(scene, code, contact, law, memory)
    moment = MOMENTS[code](scene, contact, law, memory)
    memory.normal = contact.normal
    own, other = torque_arms(code, contact)
    bent = np.cross(contact.normal, shear)
    return law.force * contact.normal + shear, moment - own * bent, -moment - other * bent
