"""From a scene to the numbers and words of a YADE deck (MindlinPhys without friction, Wall bodies).

Hertz: F = 4/3 E* a d + 2 betan sqrt(Sn m*) v, cut at zero always; E* is formed by YADE from both materials. YADE
keeps velocities at half steps, so the deck starts from v(-1/2) = v0 - g dt/2.
"""

from __future__ import annotations

import math
from pathlib import Path

from cross_check.adapters import capability
from cross_check.adapters.capability import AXES, Plane
from cross_check.adapters.interface import Deck, NotComparable, Row
from cross_check.adapters.render import number, render, table, word
from cross_check.scene import Pair, Particle, Scene, Vector

NAME = "YADE"
MAIN = "scene.py"
PARTICLES = "particles.txt"
WALLS = "walls.txt"
PARTICLE_COLUMNS = ("step", "id", "x", "y", "z", "vx", "vy", "vz", "wx", "wy", "wz", "fx", "fy", "fz", "tx", "ty", "tz")
WALL_COLUMNS = ("step", "id", "fx", "fy", "fz")
# Radius that Ig2_Wall_Sphere_ScGeom(hertzian=True) gives a wall, in radii of the sphere [-].
PLANE_RADIUS_FACTOR = 1e8


def force_cut(scene: Scene) -> str:
    """`on`: YADE always cuts. Raises NotComparable where the scene wants a dashpot that may pull."""
    if scene.model.normal.force_cut == "off" and capability.damped(scene):
        raise NotComparable("YADE always cuts the total normal force at zero, the scene lets the dashpot pull")
    return "on"


def betan_of(damping_ratio: float) -> float:
    """Return betan [-] of the dashpot 2 sqrt(5/6) b sqrt(Sn m*)."""
    return math.sqrt(5.0 / 6.0) * damping_ratio


def _vector(values: Vector) -> str:
    return f"({number(values[0])}, {number(values[1])}, {number(values[2])})"


def _velocity(scene: Scene, particle: Particle) -> Vector:
    """Velocity [m/s] half a step before the start, which gravity alone makes v0 at the start."""
    half = 0.5 * scene.time_step
    (x, y, z), (gx, gy, gz) = particle.velocity, scene.gravity
    return (x - gx * half, y - gy * half, z - gz * half)


def _material_rows(scene: Scene) -> list[Row]:
    rows: list[Row] = []
    for index, material in enumerate(scene.materials):
        young, poisson = (number(value) for value in capability.stiffness_of(scene, index))
        key, code_key = f"materials.{material.name}", f"FrictMat {index}"
        if material.rigid:
            rows.append(Row(f"{key}.rigid", "true", f"{code_key} young", young, "Pa", "rigid: 1/E = 0"))
            rows.append(Row(f"{key}.rigid", "true", f"{code_key} poisson", poisson, "-", "rigid: has no effect"))
        else:
            rows.append(Row(f"{key}.young", young, f"{code_key} young", young, "Pa", "as stated"))
            rows.append(Row(f"{key}.poisson", poisson, f"{code_key} poisson", poisson, "-", "as stated"))
    return rows


def _pair_row(scene: Scene, pair: Pair) -> Row:
    key = f"{capability.pair_key(scene, pair)}.damping_ratio"
    betan = number(betan_of(pair.damping_ratio))
    return Row(key, number(pair.damping_ratio), f"betan {pair.between[0]} {pair.between[1]}", betan, "-", "sqrt(5/6) b")


def _wall_rows(plane: Plane) -> list[Row]:
    key, place = f"bodies.{plane.name}", number(plane.position)
    rows = [Row(f"{key}.shape.point", place, f"wall axis={plane.axis}", place, "m", f"its {AXES[plane.axis]}")]
    if any(plane.velocity):
        velocity = _vector(plane.velocity)
        rows.append(Row(f"{key}.motion.velocity", velocity, "state.vel", velocity, "m/s", "as stated"))
    return rows


def deck(scene: Scene) -> Deck:
    """The YADE deck of `scene`. Raises NotComparable or InvalidScene with the reason."""
    capability.check(scene)
    if "periodic" in scene.domain.boundary:
        raise NotComparable("YADE is periodic along all three axes or none, and Wall bodies do not fit in")
    pairs = capability.touching(scene)
    for pair in pairs:
        capability.check_effective_young(scene, pair, NAME)
    cut = force_cut(scene)
    planes = capability.planes(scene)
    rows = capability.shared_rows(scene, "O.dt", ("NewtonIntegrator gravity", _vector(scene.gravity), "as stated"))
    rows += _material_rows(scene)
    rows += [_pair_row(scene, pair) for pair in pairs]
    rows.append(Row("model.normal.law", "hertz", "Law2", "ScGeom_MindlinPhys_Mindlin", "-", "no friction, betas = 0"))
    rows.append(Row("model.normal.force_cut", scene.model.normal.force_cut, "(no key)", cut, "-", "YADE always cuts"))
    rows += [row for plane in planes for row in _wall_rows(plane)]
    rows.append(Row("particles[*].velocity", "below", "state.vel", "below", "m/s", "v(-1/2) = v0 - g dt/2"))
    rows.append(Row("particles[*].mass", "below", "state.mass", "below", "kg", "as stated"))
    return Deck("yade", scene, {MAIN: _text(scene, rows, pairs, planes)}, MAIN, rows)


def _text(scene: Scene, rows: list[Row], pairs: list[Pair], planes: list[Plane]) -> str:
    stiffness = [capability.stiffness_of(scene, index) for index in range(len(scene.materials))]
    return render(
        Path(__file__).with_name("scene.py.j2"),
        {
            "name": word(scene.name),
            "main": MAIN,
            "table": table(rows),
            "materials": [
                {"index": index, "name": word(material.name), "young": number(young), "poisson": number(poisson)}
                for index, (material, (young, poisson)) in enumerate(zip(scene.materials, stiffness, strict=True))
            ],
            "matches": [
                f"({pair.between[0]}, {pair.between[1]}, {number(betan_of(pair.damping_ratio))})" for pair in pairs
            ],
            "particles": [
                {
                    "material": particle.material,
                    "radius": number(particle.radius),
                    "mass": number(particle.mass),
                    "inertia": number(particle.moment_of_inertia),
                    "position": _vector(particle.position),
                    "velocity": _vector(_velocity(scene, particle)),
                    "angular_velocity": _vector(particle.angular_velocity),
                }
                for particle in scene.particles
            ],
            "walls": [
                {
                    "name": word(plane.name),
                    "material": plane.material,
                    "axis": plane.axis,
                    "position": number(plane.position),
                    "velocity": _vector(plane.velocity),
                }
                for plane in planes
            ],
            "skin": number(0.2 * min(particle.radius for particle in scene.particles)),
            "gravity": _vector(scene.gravity),
            "time_step": number(scene.time_step),
            "every": scene.output_every,
            "steps": scene.steps,
            "particles_file": PARTICLES,
            "particle_columns": " ".join(PARTICLE_COLUMNS),
            "walls_file": WALLS,
            "wall_columns": " ".join(WALL_COLUMNS),
        },
    )
