"""Planes as LIGGGHTS has them: primitive walls, fixed or sliding, and meshes where a plane moves along its normal."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from cross_check.adapters.capability import AXES, Plane
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.render import number, numbers, render, word
from cross_check.scene import Domain


@dataclass(frozen=True)
class Wall:
    """One plane in a deck: its name, commands, rows of the translation and the mesh files that it needs."""

    name: str
    commands: list[str]
    rows: list[Row]
    files: dict[str, str] = field(default_factory=dict[str, str])


def wall_of(plane: Plane, domain: Domain, model: str, settings: str) -> Wall:
    """The wall of one plane; `model` are the first and `settings` the last words of its contact model."""
    moving = [axis for axis in range(3) if plane.velocity[axis] != 0.0]
    if len(moving) > 1:
        raise NotComparable(f"body {plane.name}: LIGGGHTS slides a wall along one axis, or pushes it along its normal")
    if plane.axis in moving:
        return _pushed(plane, domain, model, settings)
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
        _motion_row(plane, "move/mesh linear", numbers(plane.velocity)),
    ]
    commands = [
        f"fix {mesh} all mesh/surface file {file} type {plane.material + 1}",
        f"fix push_{plane.index + 1} all move/mesh mesh {mesh} linear {numbers(plane.velocity)}",
        f"fix {fix} all wall/gran model {model} store_force yes mesh n_meshes 1 meshes {mesh}{settings}",
    ]
    return Wall(word(plane.name), commands, rows, {file: text})


def _motion_row(plane: Plane, code_key: str, code_value: str) -> Row:
    key = f"bodies.{plane.name}.motion.velocity"
    return Row(key, numbers(plane.velocity), code_key, code_value, "m/s", "as stated")
