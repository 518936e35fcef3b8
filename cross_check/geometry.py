"""Where bodies meet: nearest images of a periodic box, and the surface that a sphere sees of a wall."""

from __future__ import annotations

import numpy as np

from cross_check.record import Array
from cross_check.scene import Cylinder, Domain, Scene, Shape


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


def starts_in_touch(scene: Scene) -> bool:
    """Whether any contact is there at the start."""
    center = np.array([particle.position for particle in scene.particles])
    radius = np.array([particle.radius for particle in scene.particles])
    if any(bool(np.any(facing(body.shape, center)[1] < radius)) for body in scene.bodies):
        return True
    order = np.argsort(center[:, 0], kind="stable")
    center, radius = center[order], radius[order]
    # Along x every particle meets the next one, the one after it and so on, until all are out of reach.
    for shift in range(1, len(center)):
        branch = nearest(scene.domain, np.roll(center, -shift, axis=0) - center)
        if float(np.abs(branch[:, 0]).min()) > 2.0 * float(radius.max()):
            return False
        if np.any(np.linalg.norm(branch, axis=1) < np.roll(radius, -shift) + radius):
            return True
    return False
