"""Made-up scenes and records of the study: disks on a square lattice that shrinks and cools by rule. No physics."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cross_check.record import Array, Code, Header, RunRecord
from cross_check.sintering import plan
from cross_check.sintering.plan import Run

LAW = {"law": "luding_sintering", "k1": 1e5, "k2": 2e5, "kc": 1e5, "fluid_overlap": 2e-4}
STEP = 3e-7
RADIUS = 0.996e-3
EDGE = {100: 10, 300: 17, 3: 2}
SAMPLES = 21
STAGES = {
    plan.BOX: {"press": 0.2, "heat": 0.1, "sinter": 1.0},
    plan.COOLED: {"cool": 0.1, "relax": 0.1},
    plan.COMPRESSION: {"compress": 0.1},
    plan.FAST: {"compress": 0.1},
    plan.VIBRATION: {"vibrate": 0.1},
    plan.THREE: {"press": 0.2, "heat": 0.1, "sinter": 1.0, "cool": 0.1, "relax": 0.1},
}
INWARD = {"left": (1, 0, 0), "bottom": (0, 0, 1), "right": (-1, 0, 0), "top": (0, 0, -1)}


def scene(run: Run) -> dict[str, Any]:
    """A scene with what the study reads; `told` hands the run to the made-up engine."""
    stages: list[dict[str, Any]] = [
        {"name": name, "steps": round(span / STEP), "actions": []} for name, span in STAGES[run.test].items()
    ]
    found: dict[str, Any] = {
        "case": run.case,
        "variant": run.variant,
        "seed": run.seed,
        "refinement": 0,
        "time_step": STEP,
        "steps": sum(stage["steps"] for stage in stages),
        "gravity": [0.0, 0.0, 0.0],
        "domain": {"min": [0, -0.01, 0], "max": [1, 0.01, 1], "boundary": ["open"] * 3},
        "model": {"normal": LAW},
        "pairs": [{"between": [0, 0], "friction": 0.5}, {"between": [0, 1], "friction": 0.0}],
        "bodies": [
            {"name": name, "material": 1, "shape": {"kind": "plane", "point": [0, 0, 0], "normal": list(inward)}}
            for name, inward in INWARD.items()
        ],
        "stages": stages,
        "told": [run.test, run.pressure, run.count, run.seed, run.sintering_time, run.mode],
    }
    if run.parent is not None:
        parent = scene(run.parent)
        begin = 0 if run.sintering_time is None else round((0.3 + run.sintering_time) / STEP)
        found["start"] = {"scene": parent, "step": begin if run.test == plan.COOLED else parent["steps"]}
    return found


def simulate(scene: dict[str, Any], folder: Path, states: Path, save_at: list[int]) -> RunRecord:
    """The made-up record of a scene."""
    run = Run(*scene["told"])
    for step in save_at:
        (states / f"{run.case}-{step}").write_text("state")
    ends = np.cumsum([0, *(stage["steps"] for stage in scene["stages"])])
    inner = np.round(np.linspace(0.0, float(ends[-1]), SAMPLES), 0).astype(np.int64)
    step = np.union1d(inner, ends)
    if run.test == plan.BOX:  # every 5 ms, as the cases do
        every = round(5e-3 / STEP)
        begun = [np.arange(int(a), int(b), every, dtype=np.int64) for a, b in itertools.pairwise(ends)]
        step = np.union1d(np.concatenate(begun), ends)
    time = step * STEP
    hot = (
        np.minimum(np.maximum(time - 0.3, 0.0), 1.0)
        if run.test in (plan.BOX, plan.THREE)
        else np.full(len(time), _hot(run))
    )
    cooled = np.zeros(len(time)) if run.test in (plan.BOX, plan.THREE) else np.minimum(time / 0.1, 1.0)
    if run.test not in (plan.BOX, plan.COOLED, plan.THREE):
        cooled[:] = 1.0
    depth = 1e-3 * (run.pressure / 10) ** 0.9 * (0.1 + hot**0.3) * (1 + 0.3 * cooled) + 1e-5 * run.seed
    strain = np.zeros(len(time))
    if run.test in (plan.COMPRESSION, plan.FAST):
        strain = 0.05 * (1 - np.cos(np.pi * time / time[-1]))
    return record(run, scene, step, depth, cooled, strain)


def _hot(run: Run) -> float:
    return float(run.sintering_time or 0.0)


def lattice(edge: int, depth: float) -> tuple[Array, NDArray[np.int64]]:
    """Places (N, 3) in units of the spacing, and pairs (M, 2) with walls 0 to 3 as N + wall."""
    count = edge * edge
    column, row = np.arange(count) % edge, np.arange(count) // edge
    pairs = [(i, i + 1) for i in range(count) if column[i] < edge - 1]
    pairs += [(i, i + edge) for i in range(count) if row[i] < edge - 1]
    for wall, at in enumerate((column == 0, row == 0, column == edge - 1, row == edge - 1)):
        pairs += [(int(i), count + wall) for i in np.flatnonzero(at)]
    spacing = 2 * RADIUS * (1 - depth)
    place = RADIUS * (1 - depth) + spacing * np.stack([column, np.zeros(count), row], axis=1)
    return place.astype(np.float64), np.array(pairs, dtype=np.int64)


def record(
    run: Run, scene: dict[str, Any], step: NDArray[np.int64], depth: Array, cooled: Array, strain: Array
) -> RunRecord:
    """Columns of all samples; `depth` (T,) is the relative overlap of all contacts."""
    edge, samples = EDGE[run.count], len(step)
    count = edge * edge
    random = np.random.default_rng(run.seed)
    position, point = np.zeros((samples, count, 3)), np.zeros((samples, 4, 3))
    forces: list[Array] = []
    for at in range(samples):
        place, pairs = lattice(edge, float(depth[at]))
        position[at] = place
        width = 2 * RADIUS * (1 - depth[at]) * edge
        point[at, 2, 0], point[at, 3, 2] = width, width * (1 - strain[at])
        position[at, :, 2] *= 1 - strain[at]
        unit = 2e-3 * run.pressure
        signs = np.where(random.random(len(pairs)) < 0.45 * cooled[at], -1.0, 1.0)
        forces.append(unit * signs * (0.5 + random.random(len(pairs)) * (1 + 10 * cooled[at])))
    rows = len(forces[0])
    elastic = np.concatenate(forces)
    normal = _normals(count, lattice(edge, 0.0)[1], lattice(edge, 0.0)[0])
    along, across = (
        np.tile(normal, (samples, 1)),
        np.tile(np.stack([-normal[:, 2], 0 * normal[:, 1], normal[:, 0]], 1), (samples, 1)),
    )
    friction = 0.1 * np.abs(elastic)
    body_force = np.zeros((samples, 4, 3))
    top = run.pressure * (1 + 20 * _hot(run)) * np.minimum(strain / 0.02, 1.0)
    body_force[:, 3, 2] = (run.pressure + top - top * np.minimum(np.maximum((strain - 0.02) / 0.02, 0.0), 0.5)) * point[
        :, 2, 0
    ]
    memory = np.zeros((samples * rows, 5))
    memory[:, 0] = np.repeat(2 * RADIUS * np.maximum.accumulate(depth), rows)
    columns: dict[str, NDArray[Any]] = {
        "step": step,
        "time": step * STEP,
        "position": position,
        **{name: np.zeros((samples, count, 3)) for name in ("velocity", "angular_velocity", "force", "torque")},
        "body_force": body_force,
        "body_point": point,
        "temperature": np.full(samples, 353.15),
        "radius": np.full((samples, count), RADIUS),
        "law_state": np.stack([1e5 * (0.02 + 0.98 * cooled)] * 2, axis=1),
        "contact_start": np.arange(samples + 1) * rows,
        "contact_pair": np.tile(lattice(edge, 0.0)[1], (samples, 1)),
        "contact_force": elastic[:, None] * along + friction[:, None] * across,
        "contact_elastic": elastic,
        "contact_limit": 2.0 * friction,
        "contact_memory": memory,
    }
    header = Header(
        "native", run.case, run.variant, run.seed, 0, Code("crossgrain", "0", "test"), "", "here", 1.0, STEP,
        int(step[-1]), "synchronized", "exact", [1e-5] * count, [RADIUS] * count, list(INWARD), [0.0, 0.0, 0.0],
    )  # fmt: skip
    return RunRecord(header, columns)


def _normals(count: int, pairs: NDArray[np.int64], place: Array) -> Array:
    normal = np.zeros((len(pairs), 3))
    both = pairs[:, 1] < count
    apart = place[pairs[both, 0]] - place[pairs[both, 1]]
    normal[both] = apart / np.linalg.norm(apart, axis=1)[:, None]
    for wall, inward in enumerate(INWARD.values()):
        normal[pairs[:, 1] == count + wall] = inward
    return normal


def contact(law: str, overlaps: Array, stiffness: Array, cohesive: bool = True) -> dict[str, Array]:
    """In place of one driven contact: a line."""
    del law, cohesive
    return {"force": stiffness * overlaps, "largest_overlap": overlaps, "stiffness": stiffness, "offset": 0 * overlaps}


def softening(law: str, temperatures: Array, relaxation_times: Array, steps: Array) -> Array:
    """In place of the softening: it falls from the cold value to a tenth."""
    del law, temperatures
    return 1e5 * (0.1 + 0.9 / (1 + np.cumsum(steps) / relaxation_times))
