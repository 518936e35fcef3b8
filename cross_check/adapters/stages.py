"""Stages of a scene as the codes run them: one command `run` each, with what changes between two of them."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, replace

import numpy as np

from cross_check.adapters import paths
from cross_check.adapters.interface import InvalidScene, Row
from cross_check.record import Array
from cross_check.scene import Scene


@dataclass(frozen=True)
class Segment:
    """A part of a run in which nothing changes: its name, first step, number of steps and the scene that holds.

    `leg` is the index of the leg that driven particles follow. Only a segment before the first stage has no steps.
    """

    name: str
    first: int
    steps: int
    scene: Scene
    leg: int


def segments(scene: Scene) -> list[Segment]:
    """The parts of a run; what the first stage changes holds after the sample of step 0, which is a part of its own."""
    if not scene.stages:
        lengths = paths.stage_steps(scene)
        return [Segment("", sum(lengths[:leg]), steps, scene, leg) for leg, steps in enumerate(lengths)]
    if scene.drives and [leg.steps for leg in scene.drives[0].legs] != [stage.steps for stage in scene.stages]:
        raise InvalidScene("stages and the legs of driven particles are not equally long")
    if sum(stage.steps for stage in scene.stages) != scene.steps:
        raise InvalidScene(f"the stages last {scene.stage_ends()[-1]} steps, the run has {scene.steps}")
    ends = scene.stage_ends()
    found = [
        Segment(stage.name, end - stage.steps, stage.steps, scene.at_stage(index), index)
        for index, (stage, end) in enumerate(zip(scene.stages, ends, strict=True))
    ]
    return [Segment("", 0, 0, scene, 0), *found] if scene.stages[0].actions else found


def moves(scene: Scene) -> list[object]:
    """What driven particles follow in every part of the run, in the words of `fix move variable`."""
    legs = paths.move_stages(scene)
    return [legs[part.leg]["moves"] if scene.drives else [] for part in segments(scene)]


def movers(scene: Scene) -> set[int]:
    """Indices of the bodies that move in any part of the run."""
    bodies = (enumerate(segment.scene.bodies) for segment in segments(scene))
    return {index for part in bodies for index, body in part if any(body.motion.velocity or ())}


def gravities(scene: Scene) -> Array:
    """Gravity at every sampled step, shape (T, 1, 3) [m/s2]; a change acts after the sample of its step."""
    if not scene.stages:
        return np.array(scene.gravity).reshape(1, 1, 3)
    ends = scene.stage_ends()
    values = [scene.gravity, *(scene.at_stage(index).gravity for index in range(len(ends)))]
    at = [0 if step == 0 else 1 + bisect_left(ends, step) for step in scene.sample_steps]
    return np.array([values[index] for index in at]).reshape(-1, 1, 3)


def changed_rows(segment: Segment, rows: list[Row], before: list[Row]) -> list[Row]:
    """The rows of a part of the run that the part before did not have, named by the stage."""
    return [replace(row, case_key=f"stages.{segment.name}.{row.case_key}") for row in rows if row not in before]
