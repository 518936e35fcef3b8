"""From run records to measured records: the observables of a case, by the functions of the engine, for every code."""

from __future__ import annotations

import json

import numpy as np

import crossgrain
from cross_check.engine import CaseError
from cross_check.measured import Measured
from cross_check.record import RunRecord
from cross_check.scene import Scene

RUN = "run"


def measure(scene: Scene, record: RunRecord) -> Measured:
    """The observables of a scene over the samples of a record. Raises CaseError where one is not defined there."""
    try:
        found = crossgrain.measure(json.dumps(scene.observables), _system(scene), _columns(scene, record))
    except ValueError as error:
        raise CaseError(f"{scene.name}, {record.header.source}: {error}") from error
    ends = scene.stage_ends()
    stage = np.searchsorted(ends, record.step, side="left").astype(np.int64)
    return Measured(
        header=record.header,
        time=record["time"],
        stage=stage,
        stages=tuple(item.name for item in scene.stages) or (RUN,),
        series={name: values for name, (_, values) in found.items()},
        units={name: unit for name, (unit, _) in found.items()},
    )
