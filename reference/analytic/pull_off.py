"""Undamped head-on impacts under the adhesive laws: largest attraction, restitution, and whether the bodies part.

DMT pulls hardest at the last touch, with 2 pi W R* (Derjaguin, Muller, Toporov 1975). Hertz with an attraction k A(d),
A the area of the lens of two spheres (`sjkr`) or 4 pi R* d (`sjkr2`), pulls hardest where the force has its minimum.
Both have a potential: the restitution is 1. A hysteretic contact (Luding, *Granular Matter* 10 (2008) 235) loaded to
D = v sqrt(m*/k1) has k2 = k1 + (kp - k1) D / l with l = kp / (kp - k1) phi_f 2 R*, meets the cohesive branch at
(k2 - k1) / (k2 + kc) D, where it pulls hardest, and parts if e^2 = k1 / k2 - kc (k2 - k1)^2 / (k1 k2 (k2 + kc)) is
positive.
"""

from __future__ import annotations

import math

import numpy as np

from cross_check.contact_model import AreaCohesion, LudingHysteretic
from cross_check.scene import Scene


def _radius(scene: Scene) -> float:
    one, other = (particle.radius for particle in scene.particles)
    return one * other / (one + other)


def _modulus(scene: Scene) -> float:
    compliance = 0.0
    for particle in scene.particles:
        material = scene.materials[particle.material]
        if material.young is None or material.poisson is None:
            raise ValueError(f"{scene.name}: a sphere is rigid")
        compliance += (1.0 - material.poisson**2) / material.young
    return 1.0 / compliance


def largest_attraction(scene: Scene) -> float:
    """Size of the most attractive force [N]."""
    law = scene.model.normal
    if isinstance(law, LudingHysteretic):
        depth, stiffness = _unloading(scene, law)
        return law.kc * (stiffness - law.k1) / (stiffness + law.kc) * depth
    if isinstance(law, AreaCohesion):
        return _area(scene, law)
    one, other = (particle.material for particle in scene.particles)
    pair = scene.pair(one, other)
    if law.law != "dmt" or pair is None or pair.work_of_adhesion is None:
        raise ValueError(f"{scene.name}: {law.law} has no pull-off force here")
    return 2.0 * math.pi * pair.work_of_adhesion * _radius(scene)


def _area(scene: Scene, law: AreaCohesion) -> float:
    """The minimum of Hertz less the attraction, from the slope of the area at first touch."""
    one, other = (particle.radius for particle in scene.particles)
    radius, stiffness = _radius(scene), 4.0 / 3.0 * _modulus(scene) * math.sqrt(_radius(scene))

    def area(overlap: float) -> float:
        if law.law == "sjkr2":
            return 4.0 * math.pi * radius * overlap
        distance = one + other - overlap
        lens = overlap * (distance + one - other) * (distance - one + other) * (distance + one + other)
        return 0.25 * math.pi * lens / distance**2

    slope = law.energy_density * area(1e-9 * radius) / (1e-9 * radius)
    guess = (2.0 / 3.0 * slope / stiffness) ** 2
    # At the minimum 3/2 K sqrt(d) = k A'(d); the area of the lens bends little, so that a few steps find it.
    overlap = guess
    for _ in range(50):
        width = 1e-4 * overlap
        slope = law.energy_density * (area(overlap + width) - area(overlap - width)) / (2.0 * width)
        overlap = (2.0 / 3.0 * slope / stiffness) ** 2
    return law.energy_density * area(overlap) - stiffness * overlap**1.5


def _unloading(scene: Scene, law: LudingHysteretic) -> tuple[float, float]:
    """Largest overlap [m] of the first loading and the stiffness of the unloading after it [N/m]."""
    one, other = scene.particles
    axis = np.subtract(one.position, other.position)
    speed = -float(np.dot(np.subtract(one.velocity, other.velocity), axis) / np.linalg.norm(axis))
    mass = one.mass * other.mass / (one.mass + other.mass)
    depth = speed * math.sqrt(mass / law.k1)
    limit = law.kp / (law.kp - law.k1) * law.plasticity_depth * 2.0 * _radius(scene)
    if depth > limit:
        raise ValueError(f"{scene.name}: the impact leaves the plastic range")
    return depth, law.k1 + (law.kp - law.k1) * depth / limit


def restitution(scene: Scene) -> float:
    """Rebound over impact speed [-]: 1 where the attraction has a potential."""
    law = scene.model.normal
    if isinstance(law, LudingHysteretic):
        return math.sqrt(max(_square(scene, law), 0.0))
    return 1.0


def _square(scene: Scene, law: LudingHysteretic) -> float:
    """Square of the restitution; negative where the bodies stick."""
    _, k2 = _unloading(scene, law)
    return law.k1 / k2 - law.kc * (k2 - law.k1) ** 2 / (law.k1 * k2 * (k2 + law.kc))


def separation(scene: Scene) -> float:
    """1 where the bodies part, 0 where they stick [-]."""
    law = scene.model.normal
    return float(not isinstance(law, LudingHysteretic) or _square(scene, law) > 0.0)


CLOSED_FORMS = {"largest_attraction": largest_attraction, "restitution": restitution, "separation": separation}
