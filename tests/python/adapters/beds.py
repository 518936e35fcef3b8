"""Small beds in a box with five walls: poured, settled, then changed in a second stage."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from cross_check.scene import (
    Action,
    Body,
    Domain,
    Material,
    Motion,
    Pair,
    Particle,
    Scene,
    SetGravity,
    SetMotion,
    SetPair,
    Stage,
    Vector,
)

from . import contact_scenes, scenes

RADIUS = 2e-3
STEP = 2e-5
WEIGHTY: Vector = (0.0, 0.0, -9.81)
SOFT = Material("soft", False, 5e6, 0.3, 2500.0)
SIDES = ("left", "right", "front", "back")


def lattice(layers: int, across: int, spacing: float, noise: float, speed: float = 0.0) -> tuple[Particle, ...]:
    """Spheres of 2 mm on a cubic lattice above z = 0 about the axis, moved by up to `noise` [m], in order of height."""
    random = np.random.default_rng(1)
    found: list[Particle] = []
    for z, y, x in itertools.product(range(layers), range(across), range(across)):
        site = np.array([x - 0.5 * (across - 1), y - 0.5 * (across - 1), z + 0.55]) * spacing
        place, velocity = (random.uniform(-size, size, 3) for size in (noise, speed))
        x1, y1, z1 = (float(value) for value in site + place)
        u, v, w = (float(value) for value in velocity)
        found.append(scenes.sphere(RADIUS, (x1, y1, z1), (u, v, w)))
    return tuple(found)


def box(half: float) -> tuple[Body, ...]:
    """A floor and four walls, `half` [m] from the axis."""
    sides = (
        scenes.plane("left", 1, (-half, 0.0, 0.0), (1.0, 0.0, 0.0)),
        scenes.plane("right", 1, (half, 0.0, 0.0), (-1.0, 0.0, 0.0)),
        scenes.plane("front", 1, (0.0, -half, 0.0), (0.0, 1.0, 0.0)),
        scenes.plane("back", 1, (0.0, half, 0.0), (0.0, -1.0, 0.0)),
    )
    return (scenes.plane("floor", 1, scenes.ZERO, (0.0, 0.0, 1.0)), *sides)


def bed(particles: tuple[Particle, ...], half: float, stages: tuple[Stage, ...], variant: str, every: int) -> Scene:
    """Spheres with friction 0.5 against each other and the walls, in stages."""
    low, high = (-half - 1e-3, -half - 1e-3, -2e-3), (half + 1e-3, half + 1e-3, 0.25)
    whole = scenes.scene(
        *particles,
        bodies=box(half),
        materials=(SOFT, scenes.RIGID),
        restitution=0.5,
        force_cut="on",
        gravity=WEIGHTY,
        variant=variant,
        time_step=STEP,
        steps=sum(stage.steps for stage in stages),
    )
    whole = replace(contact_scenes.mindlin(whole, 0.5, variant), output_every=every, contacts=True)
    whole = replace(whole, domain=Domain(low, high, ("open", "open", "open")))
    return replace(whole, stages=stages)


def without_friction(whole: Scene) -> tuple[Action, ...]:
    """Friction off for every pair."""

    def off(pair: Pair) -> Action:
        return SetPair(replace(pair, friction=0.0))

    return tuple(off(pair) for pair in whole.pairs)


def switched(layers: int, across: int, half: float, settle: int, after: int, every: int) -> Scene:
    """A poured bed whose friction is switched off."""
    particles = lattice(layers, across, 2.2 * RADIUS, 0.05 * RADIUS, 0.05)
    first = Stage("settle", settle)
    whole = bed(particles, half, (first,), "bed/switched", every)
    stages = (first, Stage("smooth", after, without_friction(whole)))
    return replace(whole, stages=stages, steps=settle + after)


def silo(layers: int, across: int, half: float, settle: int, after: int, every: int) -> Scene:
    """A square silo whose walls slide up."""
    particles = lattice(layers, across, 2.2 * RADIUS, 0.05 * RADIUS, 0.05)
    lift = Motion("prescribed", (0.0, 0.0, 5e-3))
    slide = tuple(SetMotion(1 + index, lift) for index in range(len(SIDES)))
    stages = (Stage("settle", settle), Stage("slide", after, slide))
    return bed(particles, half, stages, "bed/silo", every)


def tilted(whole: Scene) -> Scene:
    """The bed with gravity tilted in its second stage."""
    first, second = whole.stages
    return replace(whole, stages=(first, replace(second, actions=(SetGravity((2.0, 0.0, -9.0)),))), variant="bed/tilted")
