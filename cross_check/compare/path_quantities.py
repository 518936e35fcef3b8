"""Observables of contacts along prescribed paths."""

from __future__ import annotations

import math

import numpy as np

from cross_check.compare.quantity import Quantity, Undefined
from cross_check.record import Array, RunRecord
from cross_check.scene import Scene


def _turned(scene: Scene, record: RunRecord) -> tuple[Array, Array]:
    """Tangential force on the first particle before and after the last stage, in the frame that turns with it [N]."""
    if len(scene.particles) != 2 or len(scene.drives) != 2:
        raise Undefined("the scene is not a contact of two driven particles")
    options = scene.mirror.tangential
    if options is not None and options.pair_arms.slip != "mid_overlap":
        raise Undefined("with full radii in the slip velocity a contact slides while it turns rigidly")
    leg = scene.drives[0].legs[-1]
    first = int(np.searchsorted(record.step, scene.steps - leg.steps))
    if record.step[first] != scene.steps - leg.steps:
        raise Undefined("the record holds no sample at the beginning of the last stage")
    angle = np.array(leg.rotation) * (leg.steps * scene.time_step)
    found: list[Array] = []
    for sample, turn in ((first, 0.0), (-1, -1.0)):
        branch = record["position"][sample, 0] - record["position"][sample, 1]
        normal = branch / np.linalg.norm(branch)
        force = record["force"][sample, 0]
        found.append(_rotated(force - normal * np.dot(force, normal), turn * angle))
    if np.linalg.norm(found[0]) == 0.0:
        raise Undefined("no tangential force acts before the last stage")
    return found[0], found[1]


def _rotated(vector: Array, angle: Array) -> Array:
    """`vector` turned by a rotation vector [rad]."""
    size = float(np.linalg.norm(angle))
    if size == 0.0:
        return vector
    axis = angle / size
    along: Array = axis * float(np.dot(axis, vector))
    turned: Array = np.cross(axis, vector)
    return along + (vector - along) * math.cos(size) + turned * math.sin(size)


def tangential_length_change(scene: Scene, record: RunRecord) -> float:
    """Change of the size of the tangential force over the last stage, over that size [-]."""
    before, after = _turned(scene, record)
    return float(np.linalg.norm(after)) / float(np.linalg.norm(before)) - 1.0


def tangential_body_change(scene: Scene, record: RunRecord) -> float:
    """Size of the change of the tangential force in the turning frame over the last stage, over its size [-]."""
    before, after = _turned(scene, record)
    change: Array = after - before
    return float(np.linalg.norm(change)) / float(np.linalg.norm(before))


QUANTITIES = (
    Quantity("tangential_length_change", "-", scalar=tangential_length_change, of_law=True),
    Quantity("tangential_body_change", "-", scalar=tangential_body_change, of_law=True),
)
