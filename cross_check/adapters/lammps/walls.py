"""Walls as LAMMPS has them: planes at rest in the fix itself, cylinders and all that moves as regions."""

from __future__ import annotations

from dataclasses import dataclass

from cross_check.adapters import capability
from cross_check.adapters.capability import AXES, Plane, Tube
from cross_check.adapters.interface import Row
from cross_check.adapters.lammps import laws
from cross_check.adapters.render import number, numbers
from cross_check.adapters.stages import movers, segments
from cross_check.scene import Scene

# Formulas of the displacement along x, y and z [m] by index of the body.
Ways = dict[int, list[str]]


@dataclass(frozen=True)
class Wall:
    """The fix of one body for one material of particles: commands and rows of the translation."""

    fix: str
    body: Plane | Tube
    commands: list[str]
    rows: list[Row]


def kinds(scene: Scene) -> list[int]:
    """Material index of each atom type, in the order of the types: the materials of the particles only."""
    return sorted({particle.material for particle in scene.particles})


def ways(scene: Scene) -> list[Ways]:
    """Displacements of the walls that ever move, as formulas of the time, for every part of the run."""
    moving, parts = movers(scene), segments(scene)
    if not scene.stages:
        formulas = {index: [f"{number(u)}*time" for u in scene.bodies[index].motion.velocity or ()] for index in moving}
        return [formulas] * len(parts)
    found: list[Ways] = []
    passed = {index: [0.0, 0.0, 0.0] for index in moving}
    for part in parts:
        begin = number(part.first * scene.time_step)
        own: Ways = {}
        for index in moving:
            velocity = part.scene.bodies[index].motion.velocity or (0.0, 0.0, 0.0)
            steps = [f"+({number(u)})*(time-{begin})" if u else "" for u in velocity]
            own[index] = [number(way) + step for way, step in zip(passed[index], steps, strict=True)]
            duration = part.steps * scene.time_step
            passed[index] = [way + u * duration for way, u in zip(passed[index], velocity, strict=True)]
        found.append(own)
    return found


def _moved(wall: Plane | Tube, way: list[str] | None) -> tuple[list[str], str, list[Row]]:
    """Commands and words that move a region by variables, and their row; none for a wall that always rests."""
    if way is None:
        return [], "", []
    variables = [f"move_{wall.index + 1}_{name}" for name in AXES]
    commands = [f"variable {v} equal {formula}" for v, formula in zip(variables, way, strict=True)]
    velocity, key = numbers(wall.velocity), f"bodies.{wall.name}.motion.velocity"
    row = Row(key, velocity, f"variable move_{wall.index + 1}_*", velocity, "m/s", "velocity * time")
    return commands, f" move {' '.join('v_' + v for v in variables)}", [row]


def _tube(tube: Tube, way: list[str] | None) -> tuple[str, list[str], list[Row]]:
    """A cylinder is a region, because `zcylinder` stands at the origin only; R* = 2 R Rc / (2 Rc - R)."""
    name, values = f"tube_{tube.index + 1}", numbers((*tube.place, tube.radius))
    commands, move, rows = _moved(tube, way)
    commands.append(f"region {name} cylinder {AXES[tube.axis]} {values} INF INF side in{move} units box")
    row = Row(f"bodies.{tube.name}.shape", values, f"region {name}", values, "m", "axis, radius; R* = 2R Rc/(2Rc - R)")
    return f"region {name}", commands, [row, *rows]


def _place(plane: Plane, way: list[str] | None) -> tuple[str, list[str], list[Row]]:
    """The words that place a plane in its fix, the commands that must stand before, and the rows of the translation.

    A plane that moves in any part of the run is a region, whose displacement LAMMPS takes from variables.
    """
    key, number_of, axis = f"bodies.{plane.name}", plane.index + 1, AXES[plane.axis]
    position = number(plane.position)
    if way is None:
        sides = f"{position} NULL" if plane.side > 0 else f"NULL {position}"
        row = Row(f"{key}.shape.point", position, f"wall_{number_of} {axis}plane", sides, "m", "lo above, hi below")
        return f"{axis}plane {sides}", [], [row]
    commands, move, moved = _moved(plane, way)
    point, normal = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    point[plane.axis], normal[plane.axis] = plane.position, float(plane.side)
    region = f"region plane_{number_of} plane {numbers(point)} {numbers(normal)} side in"
    commands.append(f"{region}{move} units box")
    row = Row(f"{key}.shape.point", position, f"region plane_{number_of}", position, "m", f"its {axis}")
    return f"region plane_{number_of}", commands, [row, *moved]


def walls_of(scene: Scene, moved: Ways) -> list[Wall]:
    """The fixes of all bodies in a part of the run, with the displacements of those that ever move."""
    walls: list[Wall] = []
    pairs = {pair.between: pair for pair in capability.touching(scene)}
    for body in capability.walls(scene):
        way = moved.get(body.index)
        words, before, rows = _tube(body, way) if isinstance(body, Tube) else _place(body, way)
        style = "wall/gran/region" if before else "wall/gran"
        for kind, material in enumerate(kinds(scene), start=1):
            pair = pairs[min(material, body.material), max(material, body.material)]
            fix = f"wall_{body.index + 1}_{kind}"
            model = f"{style} granular {laws.coefficients(scene, pair)}"
            commands = [*before, f"fix {fix} type_{kind} {model} {words} contacts"]
            walls.append(Wall(fix, body, commands, rows))
            before, rows = [], []
    return walls


def force_columns(fix: str) -> tuple[str, str, str]:
    """Per-atom columns of a wall fix with keyword `contacts`: its force [N] on each particle."""
    return (f"f_{fix}[2]", f"f_{fix}[3]", f"f_{fix}[4]")
