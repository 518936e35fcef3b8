"""Where bodies meet: nearest images of a periodic box, and the surface that a sphere sees of a wall."""

from __future__ import annotations

import numpy as np

from cross_check.record import Array
from cross_check.scene import Cylinder, Domain, Shape


def nearest(domain: Domain, branch: Array) -> Array:
    """The branches between nearest images [m], shape (..., 3), of branches between places that have no jumps."""
    length = np.subtract(domain.max, domain.min)
    periodic = np.array([boundary == "periodic" for boundary in domain.boundary])
    return branch - np.where(periodic, length * np.round(branch / length), 0.0)


def facing(shape: Shape, centers: Array) -> tuple[Array, Array]:
    """Unit normals of a wall towards `centers` [m], both of shape (T, 3), and the distances of the centres [m]."""
    arm = centers - np.array(shape.point)
    if isinstance(shape, Cylinder):
        axis = np.array(shape.axis)
        radial = arm - np.outer(arm @ axis, axis)
        distance = np.linalg.norm(radial, axis=1)
        return -radial / distance[:, None], shape.radius - distance
    normal = np.array(shape.normal)
    return np.broadcast_to(normal, centers.shape), arm @ normal


def effective_radius(shape: Shape, radius: float) -> float:
    """R* [m] of a sphere of `radius` [m] at a plane, or inside a cylinder: R Rc / (Rc - R)."""
    return radius * shape.radius / (shape.radius - radius) if isinstance(shape, Cylinder) else radius
