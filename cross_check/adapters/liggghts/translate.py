"""From a scene to the numbers and words of a LIGGGHTS deck.

Hertz: F = 4/3 E* a d + 2 sqrt(5/6) b sqrt(Sn m*) v with b = -ln e / sqrt(ln^2 e + pi^2); E* is formed by LIGGGHTS
from the moduli of both materials. `limitForce on` cuts the sum at zero, the default lets it pull.
"""

from __future__ import annotations

import math
from pathlib import Path

from cross_check.adapters import capability
from cross_check.adapters.dump import HISTORY, PARTICLES, STATE
from cross_check.adapters.interface import Deck, NotComparable, Row
from cross_check.adapters.liggghts.walls import Wall, wall_of
from cross_check.adapters.render import number, numbers, render, table, word
from cross_check.scene import Pair, Scene

NAME = "LIGGGHTS"
MAIN = "scene.in"
# What LIGGGHTS accepts as coefficientRestitution.
RESTITUTION = (0.05, 1.0)
# Up to this many particles the neighbour list is found without bins, whose number a large domain would drive too high
# (meshes need bins).
WITHOUT_BINS = 64


def force_cut(scene: Scene) -> str:
    """`on` or `off`; LIGGGHTS does not cut when nothing is said."""
    return capability.resolved_cut(scene, default="off")


def restitution_of(damping_ratio: float) -> float:
    """CoefficientRestitution [-] whose dashpot is the fraction `damping_ratio` [-] of critical damping."""
    if damping_ratio >= 1.0:
        return 0.0
    return math.exp(-math.pi * damping_ratio / math.sqrt(1.0 - damping_ratio**2))


def _restitution_row(scene: Scene, pair: Pair) -> Row:
    key = capability.pair_key(scene, pair)
    code_key = f"coefficientRestitution {pair.between[0] + 1} {pair.between[1] + 1}"
    value = restitution_of(pair.damping_ratio)
    asked = pair.restitution is not None and abs(pair.restitution - value) <= capability.SAME
    if asked and pair.restitution is not None:
        value = pair.restitution
    low, high = RESTITUTION
    if not low < value <= high:
        raise NotComparable(
            f"{key}: damping_ratio {number(pair.damping_ratio)} needs coefficientRestitution {number(value)}, "
            f"LIGGGHTS accepts {low} < e <= {high}"
        )
    if asked:
        return Row(key + ".restitution", number(value), code_key, number(value), "-", "as stated")
    formula = "exp(-pi b / sqrt(1 - b^2)), b = damping_ratio"
    return Row(key + ".damping_ratio", number(pair.damping_ratio), code_key, number(value), "-", formula)


def _material_rows(scene: Scene) -> list[Row]:
    rows: list[Row] = []
    for index, material in enumerate(scene.materials):
        young, poisson = (number(value) for value in capability.stiffness_of(scene, index))
        key, kind = f"materials.{material.name}", index + 1
        if material.rigid:
            rows.append(Row(f"{key}.rigid", "true", f"youngsModulus {kind}", young, "Pa", "rigid: 1/E = 0"))
            rows.append(Row(f"{key}.rigid", "true", f"poissonsRatio {kind}", poisson, "-", "rigid: has no effect"))
        else:
            rows.append(Row(f"{key}.young", young, f"youngsModulus {kind}", young, "Pa", "as stated"))
            rows.append(Row(f"{key}.poisson", poisson, f"poissonsRatio {kind}", poisson, "-", "as stated"))
    return rows


def _restitution_matrix(scene: Scene, rows: dict[tuple[int, int], str]) -> list[str]:
    """Lines of the symmetric matrix over atom types; pairs that never touch get 1."""
    kinds = range(len(scene.materials))
    return [" ".join(rows.get((min(i, j), max(i, j)), "1") for j in kinds) for i in kinds]


def deck(scene: Scene) -> Deck:
    """The LIGGGHTS deck of `scene`. Raises NotComparable or InvalidScene with the reason."""
    capability.check(scene)
    pairs = capability.touching(scene)
    for pair in pairs:
        capability.check_effective_young(scene, pair, NAME)
    cut = force_cut(scene)
    settings = " limitForce on" if cut == "on" else ""
    walls = [wall_of(plane, scene.domain, settings) for plane in capability.planes(scene)]
    restitution = {pair.between: _restitution_row(scene, pair) for pair in pairs}
    magnitude, direction = capability.gravity(scene)
    weight = f"{number(magnitude)} vector {numbers(direction)}"
    rows = capability.shared_rows(scene, "timestep", ("fix gravity", weight, "magnitude and direction"))
    rows += _material_rows(scene)
    rows += restitution.values()
    stated = scene.model.normal.force_cut
    rows.append(Row("model.normal.law", "hertz", "pair_style gran", "model hertz", "-", "no tangential model"))
    rows.append(Row("model.normal.force_cut", stated, "limitForce", cut, "-", "default: off, the force may pull"))
    rows += [row for wall in walls for row in wall.rows]
    rows.append(Row("particles[*].radius", "below", "diameter", "below", "m", "2 R"))
    rows.append(Row("particles[*].mass", "below", "mass", "below", "kg", "as stated"))
    files = {MAIN: _text(scene, rows, restitution, walls, settings)}
    for wall in walls:
        files |= wall.files
    return Deck("liggghts", scene, files, MAIN, rows)


def _text(
    scene: Scene,
    rows: list[Row],
    restitution: dict[tuple[int, int], Row],
    walls: list[Wall],
    settings: str,
) -> str:
    meshes = any(wall.files for wall in walls)
    stiffness = [capability.stiffness_of(scene, index) for index in range(len(scene.materials))]
    magnitude, direction = capability.gravity(scene)
    domain = scene.domain
    bounds = [value for low, high in zip(domain.min, domain.max, strict=True) for value in (low, high)]
    history = ["id", *STATE, *(column for _, columns in wall_columns(scene) for column in columns)]
    return render(
        Path(__file__).with_name("scene.in.j2"),
        {
            "name": word(scene.name),
            "main": MAIN,
            "table": table(rows),
            "boundary": " ".join("p" if kind == "periodic" else "f" for kind in domain.boundary),
            "bounds": numbers(bounds),
            "materials": [f"{index + 1} {word(m.name)}" for index, m in enumerate(scene.materials)],
            "types": len(scene.materials),
            "skin": number(min(particle.radius for particle in scene.particles)),
            "search": "nsq" if len(scene.particles) <= WITHOUT_BINS and not meshes else "bin",
            "particles": [
                {
                    "id": index + 1,
                    "type": particle.material + 1,
                    "position": numbers(particle.position),
                    "diameter": number(2.0 * particle.radius),
                    "mass": number(particle.mass),
                    "velocity": [number(v) for v in particle.velocity],
                    "angular_velocity": [number(w) for w in particle.angular_velocity],
                }
                for index, particle in enumerate(scene.particles)
            ],
            "young": numbers([young for young, _ in stiffness]),
            "poisson": numbers([poisson for _, poisson in stiffness]),
            "restitution": _restitution_matrix(scene, {key: row.code_value for key, row in restitution.items()}),
            "settings": settings,
            "time_step": number(scene.time_step),
            "walls": walls,
            "gravity": number(magnitude),
            "direction": numbers(direction),
            "every": scene.output_every,
            "steps": scene.steps,
            "history_file": HISTORY,
            "history": " ".join(history),
            "history_format": " ".join(["%d"] + ["%.17g"] * (len(history) - 1)),
            "particles_file": PARTICLES,
        },
    )


def wall_columns(scene: Scene) -> list[tuple[int, tuple[str, str, str]]]:
    """Body index and dump columns of every wall: its force [N] on each particle, as `store_force yes` keeps it."""
    names = [f"f_force_wall_{index + 1}" for index in range(len(scene.bodies))]
    return [(index, (f"{name}[1]", f"{name}[2]", f"{name}[3]")) for index, name in enumerate(names)]
