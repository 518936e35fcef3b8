"""From run records to measured records: the observables of a case, by the functions of the engine, for every code."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import numpy as np

import crossgrain
from cross_check.engine import CaseError
from cross_check.measured import Measured
from cross_check.record import Array, RunRecord
from cross_check.scene import Scene

# The stage of a run that has none.
RUN = "run"
COLUMNS = ("time", "position", "angular_velocity", "force", "body_force", "body_point", "radius")
CONTACTS = ("contact_start", "contact_pair", "contact_force")


def measure(scene: Scene, record: RunRecord) -> Measured:
    """The observables of a scene over the samples of a record. Raises CaseError where one is not defined there."""
    columns = {name: record[name] for name in (*COLUMNS, *CONTACTS) if name in record.columns}
    columns["velocity"] = record.synchronized_velocity()
    if "body_point" not in columns:
        columns["body_point"] = body_points(scene, record["time"])
    names = [stage.name for stage in scene.stages]
    series: dict[str, Array] = {}
    # Pairs change from stage to stage: an observable sees those of its own.
    for stage in dict.fromkeys(item["stage"] for item in scene.observables):
        asked = json.dumps([item for item in scene.observables if item["stage"] == stage])
        try:
            series |= crossgrain.measure(asked, _system(scene.at_stage(names.index(stage))), columns)
        except ValueError as error:
            raise CaseError(f"{scene.name}, {record.header.source}: {error}") from error
    ends = scene.stage_ends()
    return Measured(
        header=record.header,
        time=record["time"],
        stage=np.searchsorted(ends, record.step, side="left").astype(np.int64),
        stages=tuple(names) or (RUN,),
        series={item["name"]: series[item["name"]] for item in scene.observables},
        units=crossgrain.measure_units(json.dumps(scene.observables)),
    )


def body_points(scene: Scene, time: Array) -> Array:
    """Points of the bodies at the sampled times, shape (T, B, 3) [m]: prescribed velocities over the stages so far.

    Raises CaseError where a body moves otherwise: only a record that has the points tells where it is.
    """
    if scene.start is not None:
        raise CaseError(
            f"{scene.name}: the record has no column body_point, and bodies begin where those of another did"
        )
    for name, kind in scene.motions():
        if kind not in ("fixed", "prescribed"):
            raise CaseError(f"{scene.name}: the record has no column body_point, and the motion of {name} is {kind}")
    ends = np.array(scene.stage_ends(), dtype=np.float64) * scene.time_step
    begins = np.concatenate(([0.0], ends[:-1]))
    points = np.zeros((len(time), len(scene.bodies), 3))
    for index, body in enumerate(scene.bodies):
        points[:, index] = body.shape.point
    for stage, (begin, end) in enumerate(zip(begins, ends, strict=True)):
        passed = np.minimum(np.maximum(time, begin), end) - begin
        for index, body in enumerate(scene.at_stage(stage).bodies):
            points[:, index] += passed[:, None] * np.array(body.motion.velocity or (0.0, 0.0, 0.0))
    return points


def _system(scene: Scene) -> str:
    """What does not change during a record, as the engine reads it."""
    system: dict[str, Any] = {
        "radius": [particle.radius for particle in scene.particles],
        "mass": [particle.mass for particle in scene.particles],
        "moment_of_inertia": [particle.moment_of_inertia for particle in scene.particles],
        "material": [particle.material for particle in scene.particles],
        "gravity": scene.gravity,
        "domain": asdict(scene.domain),
        "disks": scene.disk_height is not None,
        "bodies": [
            {"name": body.name, "material": body.material, "shape": asdict(body.shape)} for body in scene.bodies
        ],
        "friction": [
            {"between": pair.between, "value": pair.friction} for pair in scene.pairs if pair.friction is not None
        ],
    }
    return json.dumps(system)
