"""What a quantity is, and the kinematics of an impact that most of them start from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cross_check.geometry import facing, nearest
from cross_check.record import Array, RunRecord
from cross_check.scene import Scene


class UnknownQuantity(Exception):
    """A gate names a quantity or a closed form that does not exist; the message lists the known ones."""


class Undefined(Exception):
    """The record does not define the quantity; the message says why."""


@dataclass(frozen=True)
class Quantity:
    """A named observable with its unit; exactly one of `scalar` and `series` is given.

    With `of_law` the formula asks for the options of the law that made the record: a code's are those of its mirror.
    """

    name: str
    unit: str
    scalar: Callable[[Scene, RunRecord], float] | None = None
    series: Callable[[Scene, RunRecord], Array] | None = None
    of_law: bool = False


@dataclass(frozen=True)
class Impact:
    """The contact of the first particle with the second, or with the first body, at the sampled times.

    `overlap` [m], `speed` [m/s] (positive when approaching) and `force` [N] (positive when it repels), shape (T,).
    """

    time: Array
    overlap: Array
    speed: Array
    force: Array


def impact(scene: Scene, record: RunRecord) -> Impact:
    """Normal kinematics and force of the impact of a two-body scene. Raises Undefined for other scenes."""
    if len(scene.particles) + len(scene.bodies) != 2:
        raise Undefined("the scene is not an impact of two bodies")
    position, velocity = record["position"], record.synchronized_velocity()
    radius = scene.particles[0].radius
    if len(scene.particles) == 2:
        branch = nearest(scene.domain, position[:, 0] - position[:, 1])
        distance = np.linalg.norm(branch, axis=1)
        normal = branch / distance[:, None]
        overlap = radius + scene.particles[1].radius - distance
        relative = velocity[:, 0] - velocity[:, 1]
    else:
        body = scene.bodies[0]
        wall = np.array(body.motion.velocity or (0.0, 0.0, 0.0))
        normal, distance = facing(body.shape, position[:, 0] - wall * record["time"][:, None])
        overlap = radius - distance
        relative = velocity[:, 0] - wall
    return Impact(
        record["time"],
        overlap,
        -np.einsum("ij,ij->i", relative, normal),
        np.einsum("ij,ij->i", record["force"][:, 0], normal),
    )
