"""Scenes for the tests of the adapters, and an independent integrator of Hertz contacts with a dashpot."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from cross_check.scene import (
    Body,
    Domain,
    Material,
    Mirror,
    Model,
    Motion,
    NormalModel,
    Pair,
    Particle,
    Plane,
    Scene,
    Vector,
)

Array = NDArray[np.float64]
ZERO: Vector = (0.0, 0.0, 0.0)
GLASS = Material("glass", False, 1e7, 0.3, 2500.0)
STEEL = Material("steel", False, 7e7, 0.28, 7800.0)
RIGID = Material("wall", True, None, None, None)


def damping_ratio(restitution: float) -> float:
    """Fraction of critical damping [-] of the dashpot whose uncut rebound is `restitution` [-]."""
    return -math.log(restitution) / math.hypot(math.log(restitution), math.pi) if restitution < 1 else 0.0


def effective_young(first: Material, second: Material) -> float:
    """E* [Pa] of two materials; a rigid one adds no compliance."""
    compliance = 0.0
    for material in (first, second):
        if material.young is not None and material.poisson is not None:
            compliance += (1 - material.poisson**2) / material.young
    return 1 / compliance


def sphere(
    radius: float,
    position: Vector,
    velocity: Vector = ZERO,
    spin: Vector = ZERO,
    material: int = 0,
    density: float = 2500.0,
) -> Particle:
    """A homogeneous sphere."""
    mass = density * 4 / 3 * math.pi * radius**3
    return Particle(material, radius, mass, 0.4 * mass * radius**2, position, velocity, spin)


def plane(name: str, material: int, point: Vector, normal: Vector, velocity: Vector | None = None) -> Body:
    """A fixed plane, or one that moves at `velocity` [m/s]."""
    motion = Motion("fixed") if velocity is None else Motion("prescribed", velocity)
    return Body(name, material, Plane(point, normal), motion)


def scene(
    *particles: Particle,
    bodies: tuple[Body, ...] = (),
    materials: tuple[Material, ...] = (GLASS, RIGID),
    restitution: float = 0.8,
    force_cut: str = "default",
    gravity: Vector = ZERO,
    variant: str = "pair",
    time_step: float = 5e-7,
    steps: int = 2000,
    size: float = 0.1,
) -> Scene:
    """A scene in which every pair of materials has the same restitution."""
    pairs = [
        Pair((i, j), effective_young(materials[i], materials[j]), None, damping_ratio(restitution), restitution)
        for i in range(len(materials))
        for j in range(i, len(materials))
        if not (materials[i].rigid and materials[j].rigid)
    ]
    return Scene(
        schema=1,
        case="adapters",
        variant=variant,
        seed=None,
        refinement=0,
        level="L1",
        time_step=time_step,
        steps=steps,
        output_every=1,
        gravity=gravity,
        domain=Domain((-size, -size, -size), (size, size, size), ("open", "open", "open")),
        materials=materials,
        pairs=tuple(pairs),
        model=Model(NormalModel("hertz", force_cut)),
        mirror=Mirror(None, "synchronized"),
        bodies=bodies,
        particles=particles,
    )


def pair(force_cut: str = "default", restitution: float = 0.8, variant: str = "pair") -> Scene:
    """The head-on collision of the README of the reference codes: 5 and 3 mm, 1 m/s."""
    left = sphere(5e-3, ZERO, (0.5, 0.0, 0.0))
    right = sphere(3e-3, (8.001e-3, 0.0, 0.0), (-0.5, 0.0, 0.0))
    return scene(left, right, force_cut=force_cut, restitution=restitution, variant=variant)


def oblique_pair() -> Scene:
    """Unlike materials, off-centre and spinning: only a frictionless contact leaves the spins alone."""
    left = sphere(5e-3, (0.01, 0.02, 0.03), (0.5, 0.1, 0.0), (10.0, -20.0, 30.0))
    right = sphere(3e-3, (0.0163, 0.0240, 0.0333), (-0.5, -0.3, -0.2), (0.0, 5.0, -70.0), 1, 7800.0)
    return scene(left, right, materials=(GLASS, STEEL), force_cut="on", variant="oblique")


def floor() -> Scene:
    """A sphere that falls on a rigid plane under gravity."""
    ball = sphere(5e-3, (1e-3, 5e-4, 5.001e-3), (0.1, 0.0, -0.5))
    bodies = (plane("floor", 1, ZERO, (0.0, 0.0, 1.0)),)
    return scene(ball, bodies=bodies, gravity=(0.0, 0.0, -9.81), variant="floor/on", force_cut="on")


def moving_floor(velocity: Vector) -> Scene:
    """A sphere without weight that meets a rigid plane moving at `velocity` [m/s]."""
    return replace(floor(), bodies=(plane("floor", 1, ZERO, (0.0, 0.0, 1.0), velocity),), gravity=ZERO)


def rising_floor() -> Scene:
    """A plane that moves along its normal."""
    return replace(moving_floor((0.0, 0.0, 0.25)), variant="floor/rising")


def corner() -> Scene:
    """Two unlike spheres against a plane each, seen from below and from the side, no damping."""
    up = sphere(5e-3, (0.02, 0.0, 0.0449), (0.0, 0.0, 0.5))
    side = sphere(3e-3, (-0.0469, 0.0, 0.0), (-0.5, 0.0, 0.0), (0.0, 0.0, 0.0), 1, 7800.0)
    bodies = (
        plane("roof", 2, (0.0, 0.0, 0.05), (0.0, 0.0, -1.0)),
        plane("side", 2, (-0.05, 0.0, 0.0), (1.0, 0.0, 0.0)),
    )
    materials = (GLASS, STEEL, RIGID)
    return scene(up, side, bodies=bodies, materials=materials, restitution=1.0, force_cut="off", variant="corner")


def free_fall() -> Scene:
    """A sphere under gravity along no axis."""
    ball = sphere(5e-3, (0.0, 0.0, 0.05), (0.3, 0.0, 1.0))
    return scene(ball, gravity=(0.5, -1.0, -9.81), variant="fall", time_step=1e-5)


def powder() -> Scene:
    """Grains of 10 um in a domain of 0.2 m."""
    left = sphere(1e-5, ZERO, (0.05, 0.0, 0.0))
    right = sphere(1e-5, (2.0001e-5, 0.0, 0.0), (-0.05, 0.0, 0.0))
    return scene(left, right, variant="powder", force_cut="on", time_step=2e-9, steps=3000)


def boulder() -> Scene:
    """A ball of 0.1 m on a stiff plane."""
    ball = sphere(0.1, (0.0, 0.0, 0.1001), (0.0, 0.0, -0.2))
    bodies = (plane("floor", 1, ZERO, (0.0, 0.0, 1.0)),)
    return scene(ball, bodies=bodies, variant="boulder", force_cut="on", time_step=1e-5, size=0.5)


def soft() -> Scene:
    """A dashpot so strong that LAMMPS needs a negative number."""
    return pair("on", 0.1, "restitution=0.1")


def sampled(whole: Scene, every: int) -> Scene:
    """The same run with a sample every `every` steps."""
    return replace(whole, output_every=every, variant=f"{whole.variant}/every={every}")


def integrate(whole: Scene, cut: bool, plane_factor: float | None) -> tuple[Array, Array]:
    """Positions [m] and contact forces [N] at every step, shape (steps + 1, N, 3), by kick and drift.

    Forces of step n see x(n) and v(n - 1/2). Written from the formulas, without a look at the adapters.
    """
    dt, gravity = whole.time_step, np.array(whole.gravity)
    x = np.array([p.position for p in whole.particles])
    v = np.array([p.velocity for p in whole.particles]) - 0.5 * dt * gravity
    mass = np.array([p.mass for p in whole.particles])
    radius = [p.radius for p in whole.particles]
    kind = [p.material for p in whole.particles]
    places, forces = np.empty((whole.steps + 1, *x.shape)), np.zeros((whole.steps + 1, *x.shape))
    for n in range(whole.steps + 1):
        f = forces[n]
        places[n] = x
        for i in range(len(x)):
            for j in range(i):
                normal = x[i] - x[j]
                distance = math.sqrt(float(normal @ normal))
                normal = normal / distance
                reduced_radius = radius[i] * radius[j] / (radius[i] + radius[j])
                reduced_mass = mass[i] * mass[j] / (mass[i] + mass[j])
                approach = -float((v[i] - v[j]) @ normal)
                overlap = radius[i] + radius[j] - distance
                size = hertz(whole, (kind[i], kind[j]), reduced_radius, reduced_mass, overlap, approach, cut)
                f[i] += size * normal
                f[j] -= size * normal
            for body in whole.bodies:
                assert isinstance(body.shape, Plane)
                normal = np.array(body.shape.normal)
                overlap = radius[i] - float((x[i] - np.array(body.shape.point)) @ normal)
                r = radius[i] if plane_factor is None else radius[i] * plane_factor / (1 + plane_factor)
                approach = -float(v[i] @ normal)
                size = hertz(whole, (kind[i], body.material), r, float(mass[i]), overlap, approach, cut)
                f[i] += size * normal
        v = v + dt * (f / mass[:, None] + gravity)
        x = x + dt * v
    return places, forces


def hertz(
    whole: Scene, between: tuple[int, int], radius: float, mass: float, overlap: float, approach: float, cut: bool
) -> float:
    """Repulsive force [N] of one contact: 4/3 E* a d + 2 sqrt(5/6) b sqrt(2 E* a m) v."""
    if overlap <= 0:
        return 0.0
    values = whole.pair(*between)
    assert values is not None
    contact_radius = math.sqrt(radius * overlap)
    elastic = 4 / 3 * values.effective_young * contact_radius * overlap
    critical = 2 * math.sqrt(5 / 6) * math.sqrt(2 * values.effective_young * contact_radius * mass)
    force = elastic + values.damping_ratio * critical * approach
    return max(force, 0.0) if cut else force
