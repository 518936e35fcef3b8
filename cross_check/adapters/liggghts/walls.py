"""Walls as LIGGGHTS has them: primitive planes and cylinders at rest or sliding, meshes for planes that are pushed."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from cross_check.adapters import capability
from cross_check.adapters.capability import AXES, Plane, Tube
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.render import number, numbers, render, word
from cross_check.adapters.stages import segments
from cross_check.scene import Domain, Scene


@dataclass(frozen=True)
class Wall:
    """One wall in a deck: its name, commands, rows of the translation and the mesh files that it needs."""

    name: str
    commands: list[str]
    rows: list[Row]
    files: dict[str, str] = field(default_factory=dict[str, str])


def pushed(scene: Scene) -> set[int]:
    """Indices of the planes that move along their normal in any part of the run: they are meshes in all of it."""
    walls = (wall for part in segments(scene) for wall in capability.walls(part.scene))
    return {wall.index for wall in walls if isinstance(wall, Plane) and wall.velocity[wall.axis] != 0.0}


def wall_of(wall: Plane | Tube, domain: Domain, model: str, settings: str, meshes: set[int]) -> Wall:
    """The wall of one body; `model` are the first and `settings` the last words of its contact model.

    `meshes` are the indices of the planes that are meshes.
    """
    if isinstance(wall, Tube):
        return _tube(wall, model, settings)
    return _pushed(wall, domain, model, settings) if wall.index in meshes else _plane(wall, model, settings)


def _tube(tube: Tube, model: str, settings: str) -> Wall:
    """A primitive cylinder, at rest or sliding along itself; R* = R, so that it curves like a plane."""
    moving = [axis for axis in range(3) if tube.velocity[axis] != 0.0]
    if moving not in ([], [tube.axis]):
        raise NotComparable(f"body {tube.name}: LIGGGHTS slides a cylinder along itself only")
    fix, place = f"wall_{tube.index + 1}", f"{AXES[tube.axis]}cylinder"
    # `ycylinder` takes z before x: the coordinates go round.
    place_of = tube.place if tube.axis != 1 else tube.place[::-1]
    key, values = f"bodies.{tube.name}", numbers((tube.radius, *place_of))
    rows = [Row(f"{key}.shape", values, f"{fix} {place}", values, "m", "radius, axis; R* = R")]
    shear = ""
    if moving:
        shear = f" shear {AXES[tube.axis]} {number(tube.velocity[tube.axis])}"
        rows.append(_motion_row(tube, f"{fix} shear", shear.removeprefix(" shear ")))
    words = f"primitive type {tube.material + 1} {place} {values}{shear}{settings}"
    return Wall(word(tube.name), [f"fix {fix} all wall/gran model {model} store_force yes {words}"], rows)


def _plane(plane: Plane, model: str, settings: str) -> Wall:
    moving = [axis for axis in range(3) if plane.velocity[axis] != 0.0]
    if len(moving) > 1:
        raise NotComparable(f"body {plane.name}: LIGGGHTS slides a wall along one axis, or pushes it along its normal")
    fix, place = f"wall_{plane.index + 1}", f"{AXES[plane.axis]}plane"
    key, position = f"bodies.{plane.name}", number(plane.position)
    rows = [Row(f"{key}.shape.point", position, f"{fix} {place}", position, "m", "as stated")]
    shear = ""
    if moving:
        shear = f" shear {AXES[moving[0]]} {number(plane.velocity[moving[0]])}"
        rows.append(_motion_row(plane, f"{fix} shear", shear.removeprefix(" shear ")))
    words = f"primitive type {plane.material + 1} {place} {position}{shear}{settings}"
    return Wall(word(plane.name), [f"fix {fix} all wall/gran model {model} store_force yes {words}"], rows)


def _pushed(plane: Plane, domain: Domain, model: str, settings: str) -> Wall:
    """A mesh of two triangles across the domain; a primitive wall cannot move along its normal."""
    if sum(v != 0.0 for v in plane.velocity) > 1:
        raise NotComparable(f"body {plane.name}: LIGGGHTS slides a wall along one axis, or pushes it along its normal")
    fix, mesh = f"wall_{plane.index + 1}", f"mesh_{plane.index + 1}"
    file = f"{mesh}.stl"
    first, second = ((plane.axis + 1) % 3, (plane.axis + 2) % 3)
    if plane.side < 0:
        first, second = second, first
    corners: list[str] = []
    for low_first, low_second in ((True, True), (False, True), (False, False), (True, False)):
        corner = [plane.position] * 3
        corner[first] = domain.min[first] if low_first else domain.max[first]
        corner[second] = domain.min[second] if low_second else domain.max[second]
        corners.append(numbers(corner))
    normal = [0.0, 0.0, 0.0]
    normal[plane.axis] = float(plane.side)
    triangles = [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    text = render(Path(__file__).with_name("plane.stl.j2"), {"normal": numbers(normal), "triangles": triangles})
    key, position = f"bodies.{plane.name}", number(plane.position)
    rows = [
        Row(f"{key}.shape.point", position, file, position, "m", "two triangles across the domain"),
    ]
    push: list[str] = []
    if any(plane.velocity):
        rows.append(_motion_row(plane, "move/mesh linear", numbers(plane.velocity)))
        push = [f"fix push_{plane.index + 1} all move/mesh mesh {mesh} linear {numbers(plane.velocity)}"]
    commands = [
        f"fix {mesh} all mesh/surface file {file} type {plane.material + 1}",
        *push,
        f"fix {fix} all wall/gran model {model} store_force yes mesh n_meshes 1 meshes {mesh}{settings}",
    ]
    return Wall(word(plane.name), commands, rows, {file: text})


def _motion_row(wall: Plane | Tube, code_key: str, code_value: str) -> Row:
    key = f"bodies.{wall.name}.motion.velocity"
    return Row(key, numbers(wall.velocity), code_key, code_value, "m/s", "as stated")
