"""Elastic head-on impact of a Hertz contact: closed forms from the energy balance.

With m* v^2 / 2 = 8/15 E* sqrt(R*) d^(5/2) at the largest overlap d, the peak force is 5/4 m* v^2 / d and the duration
is twice the integral of dx / sqrt(1 - x^(5/2)) over (0, 1) times d / v, which is 4/5 B(2/5, 1/2) d / v with Euler's
beta function.

Source: Johnson, *Contact Mechanics* (1985), section 11.4. Mixed values are formed here from the materials, not taken
from the engine, so that a wrong mixing rule shows.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import beta

from cross_check.geometry import effective_radius, facing, nearest
from cross_check.scene import Material, Scene


def _compliance(material: Material) -> float:
    if material.young is None or material.poisson is None:
        return 0.0
    return (1.0 - material.poisson**2) / material.young


def _impact(scene: Scene) -> tuple[float, float, float]:
    """Largest overlap [m], reduced mass [kg] and speed [m/s] of the impact of the first particle."""
    sphere = scene.particles[0]
    mass = 4.0 / 3.0 * math.pi * sphere.radius**3 * (scene.materials[sphere.material].density or math.nan)
    if len(scene.particles) == 2:
        other = scene.particles[1]
        other_mass = 4.0 / 3.0 * math.pi * other.radius**3 * (scene.materials[other.material].density or math.nan)
        axis = nearest(scene.domain, np.subtract(sphere.position, other.position))
        speed = -float(np.dot(np.subtract(sphere.velocity, other.velocity), axis) / np.linalg.norm(axis))
        radius = 1.0 / (1.0 / sphere.radius + 1.0 / other.radius)
        mass = 1.0 / (1.0 / mass + 1.0 / other_mass)
        partner = other.material
    else:
        body = scene.bodies[0]
        relative = np.subtract(sphere.velocity, body.motion.velocity or (0.0, 0.0, 0.0))
        normal, _ = facing(body.shape, np.array([sphere.position]))
        speed = -float(np.dot(relative, normal[0]))
        radius, partner = effective_radius(body.shape, sphere.radius), body.material
    compliance = _compliance(scene.materials[sphere.material]) + _compliance(scene.materials[partner])
    overlap = (15.0 / 16.0 * mass * speed**2 * compliance / math.sqrt(radius)) ** 0.4
    return overlap, mass, speed


def peak_force(scene: Scene) -> float:
    """Largest force [N]."""
    overlap, mass, speed = _impact(scene)
    return 1.25 * mass * speed**2 / overlap


def contact_duration(scene: Scene) -> float:
    """Time from first touch to separation [s]."""
    overlap, _, speed = _impact(scene)
    return 0.8 * float(beta(0.4, 0.5)) * overlap / speed


CLOSED_FORMS = {"peak_force": peak_force, "contact_duration": contact_duration}
