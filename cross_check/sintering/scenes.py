"""Scenes of the study's runs, as the engine writes and reads them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import crossgrain
from cross_check import engine
from cross_check.engine import CaseError
from cross_check.record import RunRecord, read
from cross_check.sintering.errors import StudyError
from cross_check.sintering.plan import Run
from cross_check.suites import FOLDER

Scene = dict[str, Any]
"""A scene as JSON (docs/formats.md); one that branches off holds the scene of its start in `start`."""

_engine: Any = crossgrain

# By how much of it the time of a run may differ from the planned one: whole steps.
SHARE = 1e-3


@dataclass
class Planned:
    """A run with its scene; `key` names its results, `save_at` are the steps whose states its branches need."""

    run: Run
    scene: Scene
    key: str
    series: str = ""
    save_at: list[int] = field(default_factory=list[int])


def load(run: Run) -> Scene:
    """The one scene of a run. Raises CaseError, or StudyError where the case makes another number of scenes."""
    path = FOLDER / f"{run.case.replace('-', '_')}.toml"
    try:
        found = json.loads(_engine.load_case(path, run.overrides, run.variant))
    except ValueError as error:
        raise CaseError(f"{run.name}: {error}") from error
    scenes = [scene for scene in found["scenes"] if scene["refinement"] == 0 and scene["variant"] == run.variant]
    if len(scenes) != 1:
        raise StudyError(f"{run.name}: the case makes {len(scenes)} scenes of this variant and seed, expected one")
    (scene,) = scenes
    lasts = scene["steps"] * scene["time_step"]
    if abs(lasts - run.duration) > SHARE * run.duration:
        raise StudyError(f"{run.name}: lasts {lasts:.6g} s, the study plans {run.duration:.6g} s")
    return scene


def simulate(scene: Scene, folder: Path, states: Path, save_at: list[int]) -> RunRecord:
    """Runs a scene and returns its record, which lies in `folder`. Raises CaseError or RecordError."""
    try:
        _engine.run_scene(json.dumps(scene), folder, 1, states=states, save_at=save_at)
    except ValueError as error:
        raise CaseError(str(error)) from error
    return read(folder)


def prepare(runs: Iterable[Run], measuring: str) -> list[Planned]:
    """The runs with their scenes and keys, and the steps that each has to save for its branches.

    `measuring` is the hash of the functions that measure. Raises CaseError, or StudyError where a branch starts from
    another scene than its parent's: its results would then belong to another sample.
    """
    found: dict[Run, Planned] = {}
    for run in runs:
        scene = load(run)
        found[run] = Planned(run, scene, _key(scene, measuring))
    for run, planned in found.items():
        if run.root in found:
            planned.series = found[run.root].key
        if run.parent is None:
            continue
        parent = found.get(run.parent)
        start = planned.scene.get("start")
        if parent is None or start is None:
            what = "its parent is not planned" if parent is None else "its scene does not say from what it starts"
            raise StudyError(f"{run.name}: {what}")
        other = _difference(parent.scene, start["scene"])
        if other is not None:
            raise StudyError(f"{run.name}: starts from another scene than that of {parent.run.name}; {other} differs")
        start["scene"] = parent.scene  # the same values once in memory
        if start["step"] not in parent.save_at:
            parent.save_at.append(int(start["step"]))
    for planned in found.values():
        planned.save_at.sort()
    return list(found.values())


def _key(scene: Scene, measuring: str) -> str:
    """Names the results of a scene: they hold for this engine and these functions only."""
    digest = hashlib.blake2b(digest_size=16)
    for part in (json.dumps(scene, sort_keys=True), engine.build(), measuring):
        digest.update(f"{len(part)}:{part}".encode())
    return digest.hexdigest()


def _difference(left: Any, right: Any, where: str = "scene") -> str | None:
    """The first place where two JSON values differ, or None."""
    if isinstance(left, dict) and isinstance(right, dict):
        for name in [*left, *(name for name in right if name not in left)]:  # pyright: ignore[reportUnknownVariableType]
            found = _difference(left.get(name), right.get(name), f"{where}.{name}")  # pyright: ignore[reportUnknownArgumentType,reportUnknownMemberType]
            if found is not None:
                return found
        return None
    return None if left == right else where
