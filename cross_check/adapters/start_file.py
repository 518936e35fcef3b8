"""The start of many particles as a data file, which LIGGGHTS and LAMMPS read alike: atom styles granular and sphere.

A mass cannot be stated there: the density is m / (4/3 pi R^3), from which the codes form the mass to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cross_check.adapters.interface import Row
from cross_check.adapters.render import number, numbers, word
from cross_check.scene import Scene

START = "start.data"
# Up to this many particles stand in the deck itself, one command each, and neighbours are found without bins.
FEW = 64


def many(scene: Scene) -> bool:
    """Whether the particles stand in a file of their own."""
    return len(scene.particles) > FEW


def skin(scene: Scene) -> float:
    """Distance of surfaces up to which neighbours are listed [m].

    Few particles have long lists for nothing lost; in a bed every listed neighbour costs time at every step.
    """
    smallest = min(particle.radius for particle in scene.particles)
    return 0.4 * smallest if many(scene) else smallest


def data_file(scene: Scene, types: Sequence[int], kinds: int) -> str:
    """The text of the data file: box, then type, diameter, density and place, then velocity and spin of each."""
    domain = scene.domain
    lines = [f"Start of {word(scene.name)}, written by Crossgrain", "", f"{len(scene.particles)} atoms"]
    lines += [f"{kinds} atom types", ""]
    for axis, low, high in zip("xyz", domain.min, domain.max, strict=True):
        lines.append(f"{numbers((low, high))} {axis}lo {axis}hi")
    lines += ["", "Atoms", ""]
    for index, (kind, particle) in enumerate(zip(types, scene.particles, strict=True), start=1):
        density = particle.mass / (4.0 * math.pi / 3.0 * particle.radius * particle.radius * particle.radius)
        lines.append(f"{index} {kind} {number(2.0 * particle.radius)} {number(density)} {numbers(particle.position)}")
    lines += ["", "Velocities", ""]
    for index, particle in enumerate(scene.particles, start=1):
        lines.append(f"{index} {numbers((*particle.velocity, *particle.angular_velocity))}")
    return "\n".join(lines) + "\n"


def rows(scene: Scene) -> list[Row]:
    """The translation of size and mass."""
    if not many(scene):
        return [
            Row("particles[*].radius", "below", "diameter", "below", "m", "2 R"),
            Row("particles[*].mass", "below", "mass", "below", "kg", "as stated"),
        ]
    return [
        Row("particles[*].radius", START, "diameter", START, "m", "2 R"),
        Row("particles[*].mass", START, "density", START, "kg/m3", "m / (4/3 pi R^3)"),
    ]
