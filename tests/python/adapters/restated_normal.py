"""Normal forces of LIGGGHTS, YADE and LAMMPS re-stated from their formulas."""

from __future__ import annotations

import math

from cross_check.contact_model import AreaCohesion, LinearHistory, LinearSpringDashpot, LudingHysteretic
from cross_check.scene import Scene

from .restated_contact import Contact, Memory, Stiffness


def stiffness(scene: Scene, code: str, contact: Contact, memory: Memory, cut: bool) -> Stiffness:
    """Normal force, tangential stiffness and dashpot constant of the laws of the scene."""
    law = scene.model.normal
    if isinstance(law, LinearSpringDashpot):
        tangential = scene.model.tangential
        linear = tangential if isinstance(tangential, LinearHistory) else LinearHistory("", 0.0, 0.0)
        elastic = law.stiffness * contact.overlap
        force = elastic + law.dashpot * contact.approach
        force = max(force, 0.0) if cut else force
        return Stiffness(force, force, elastic, linear.stiffness_ratio * law.stiffness, linear.dashpot)
    if isinstance(law, LudingHysteretic):
        elastic = luding(law, code, contact, memory)
        force = elastic + law.dashpot * contact.approach
        return Stiffness(force, force, elastic, 0.0, 0.0)
    return hertz(scene, code, contact, cut)


def hertz(scene: Scene, code: str, contact: Contact, cut: bool) -> Stiffness:
    """Hertz, alone or with an attraction."""
    law, pair = scene.model.normal, contact.pair
    elastic = 4 / 3 * pair.effective_young * contact.spot * contact.overlap
    critical = 2 * math.sqrt(5 / 6) * pair.damping_ratio
    damping = critical * math.sqrt(2 * pair.effective_young * contact.spot * contact.mass) * contact.approach
    shear = 8 * (pair.effective_shear or 0.0) * contact.spot
    dashpot = critical * math.sqrt(shear * contact.mass)
    if law.law == "dmt":
        pull = 2 * math.pi * (pair.work_of_adhesion or 0.0) * contact.reduced_radius
        if code == "yade" and elastic - pull + damping < 0 and abs(damping) > pull:
            damping = math.copysign(pull, damping)
        force = elastic - pull + damping
        return Stiffness(force, pull + abs(force), elastic - pull, shear, dashpot)
    force = max(elastic + damping, 0.0) if cut else elastic + damping
    attraction = law.energy_density * area(law.law, contact) if isinstance(law, AreaCohesion) else 0.0
    return Stiffness(force - attraction, force, elastic, shear, dashpot)


def area(name: str, contact: Contact) -> float:
    """Area [m2] that the cohesion of LIGGGHTS acts on."""
    own, other = contact.radii
    if name == "sjkr2":
        return (2 if contact.wall else 4) * math.pi * contact.reduced_radius * contact.overlap
    if contact.wall:
        return math.pi * (own**2 - (own - contact.overlap) ** 2)
    r = own + other - contact.overlap
    return -math.pi / 4 * (r - own - other) * (r + own - other) * (r - own + other) * (r + own + other) / r**2


def luding(law: LudingHysteretic, code: str, contact: Contact, memory: Memory) -> float:
    """Elastic force [N] of the hysteretic law; a wall of YADE has no radius, hence no plastic range."""
    k1, kp, kc, overlap = law.k1, law.kp, law.kc, contact.overlap
    radius = 0.0 if code == "yade" and contact.wall else contact.reduced_radius
    depth = law.plasticity_depth * 2 * radius
    limit = kp / (kp - k1) * depth
    if code == "yade":
        return luding_pm(law, overlap, limit, depth, memory)
    memory.largest = max(memory.largest, overlap)
    if memory.largest >= limit:
        k2, line = kp, kp * (overlap - limit) + k1 * limit
    else:
        k2 = k1 + (kp - k1) * memory.largest / limit
        line = k2 * (overlap - memory.largest) + k1 * memory.largest
        if line >= k1 * overlap:
            return k1 * overlap
    if line > -kc * overlap:
        return line
    memory.largest = (k2 + kc) / (k2 - k1) * overlap
    return -kc * overlap


def luding_pm(law: LudingHysteretic, overlap: float, limit: float, depth: float, memory: Memory) -> float:
    """YADE: k2 from the largest overlap of the last step, the cohesive branch only while the overlap falls."""
    k1, kp, kc = law.k1, law.kp, law.kc
    k2 = kp if memory.largest >= limit else k1 + (kp - k1) * memory.largest / limit
    last, memory.last = memory.last, overlap
    if overlap > memory.largest:
        memory.largest = overlap
        memory.offset = min((1 - k1 / k2) * overlap, depth)
    line = k2 * (overlap - memory.offset)
    if line >= k1 * overlap:
        return k1 * overlap if overlap < limit else line
    if line > -kc * overlap or overlap >= last:
        return line
    memory.largest = overlap * (k2 + kc) / (k2 - k1)
    memory.offset = min((1 - k1 / k2) * memory.largest, depth)
    return -kc * overlap
