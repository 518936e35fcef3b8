"""Triangles of walls, cut to the domain: planes as polygons, cylinders as strips of flat faces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cross_check.export.trajectory import ExportError, Trajectory
from cross_check.record import Array
from cross_check.scene import Cylinder, Domain, Plane, Shape

Triangles = NDArray[np.int64]
FACES = 64
"""Flat faces around a cylinder. Their corners lie on it, their middles nearer to the axis by 0.12 % of the radius."""


def wall_triangles(trajectory: Trajectory, sample: int = 0) -> tuple[Array, Triangles, Triangles]:
    """Points (P, 3) [m], triangles (F, 3) and the number of the body of every triangle (F,), at a sample.

    A wall is cut to the domain where it starts and then moves whole; one that does not meet the domain has no
    triangles. Raises ExportError where the case is not known or does not tell where a body is.
    """
    scene = trajectory.scene
    if scene is None:
        raise ExportError(f"{trajectory.name}: a record does not tell the shapes of walls; give the case")
    points, triangles, bodies, total = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)], list[Triangles](), 0
    for number, body in enumerate(scene.bodies):
        place = trajectory.shape_at(number, sample)
        if place is None:
            motion = f"bodies.{number}.motion = {body.motion.kind}"
            raise ExportError(f"{motion}: known are fixed and prescribed walls, and those with the column body_point")
        corners, faces = triangulate(body.shape, scene.domain)
        points.append(corners + np.subtract(place.point, body.shape.point))
        triangles.append(faces + total)
        bodies.append(np.full(len(faces), number))
        total += len(corners)
    return np.concatenate(points), np.concatenate(triangles), np.concatenate(bodies or [np.empty(0, dtype=np.int64)])


def triangulate(shape: Shape, domain: Domain) -> tuple[Array, Triangles]:
    """Points [m] and triangles of one wall in the domain; normals of the triangles point to the particles."""
    if isinstance(shape, Plane):
        return _fan(_polygon(shape, domain))
    return _tube(shape, domain)


def _across(axis: Array) -> tuple[Array, Array]:
    """Two unit vectors that make a right-handed frame with the unit vector `axis`; exact for axes of coordinates."""
    first = _cross(axis, np.eye(3)[(int(np.argmax(np.abs(axis))) + 2) % 3])
    first = first / np.linalg.norm(first)
    return first, _cross(axis, first)


def _cross(left: Array, right: Array) -> Array:
    return np.asarray(np.cross(left, right), dtype=np.float64)


def _polygon(plane: Plane, domain: Domain) -> Array:
    """Corners (V, 3) of the part of a plane in the domain, anticlockwise about the normal: a square that is cut."""
    low, high = np.array(domain.min), np.array(domain.max)
    normal = np.array(plane.normal)
    center = 0.5 * (low + high)
    center -= ((center - np.array(plane.point)) @ normal) * normal
    size = float(np.linalg.norm(high - low))
    first, second = _across(normal)
    corners = [center + size * (a * first + b * second) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    for axis in range(3):
        for sign, limit in ((1.0, low[axis]), (-1.0, -high[axis])):
            corners = _cut(corners, axis, sign, limit, 1e-12 * size)
    return np.stack(corners) if corners else np.empty((0, 3))


def _cut(corners: list[Array], axis: int, sign: float, limit: float, slack: float) -> list[Array]:
    """The part of a convex polygon where sign x[axis] >= limit (Sutherland and Hodgman, 1974)."""
    kept: list[Array] = []
    for before, here in zip(corners[-1:] + corners[:-1], corners, strict=True):
        a, b = sign * before[axis] - limit, sign * here[axis] - limit
        if (a < -slack) != (b < -slack):
            crossing = before + a / (a - b) * (here - before)
            crossing[axis] = sign * limit
            kept.append(crossing)
        if b >= -slack:
            kept.append(here)
    return kept


def _fan(corners: Array) -> tuple[Array, Triangles]:
    middle = np.arange(1, max(len(corners) - 1, 1))
    return corners, np.stack([np.zeros_like(middle), middle, middle + 1], axis=1)


def _tube(cylinder: Cylinder, domain: Domain) -> tuple[Array, Triangles]:
    """The tube between the ends of the domain along its axis."""
    axis, point = np.array(cylinder.axis), np.array(cylinder.point)
    low, high = np.array(domain.min), np.array(domain.max)
    corners = np.array([[(low, high)[bit >> place & 1][place] for place in range(3)] for bit in range(8)])
    along = (corners - point) @ axis
    angle = 2 * np.pi * np.arange(FACES) / FACES
    first, second = _across(axis)
    ring = cylinder.radius * (np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * second) + point
    points = np.concatenate([ring + along.min() * axis, ring + along.max() * axis])
    a = np.arange(FACES)
    b = (a + 1) % FACES
    return points, np.concatenate([np.stack([a, a + FACES, b], axis=1), np.stack([b, a + FACES, b + FACES], axis=1)])
