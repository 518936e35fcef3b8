"""How a sample goes on in time: density, coordination and wall stress at every sample of a record."""

from __future__ import annotations

import json

import numpy as np

import crossgrain
from cross_check.record import Array, RunRecord
from cross_check.sintering.outcome import Arrays, Numbers
from cross_check.sintering.scenes import Scene
from cross_check.sintering.snapshot import Indices, inner_box

# Fewest contacts, those with walls counted, of a disk that is no rattler: one more than dimensions.
HELD = 3
_EVERYWHERE = {"kind": "everything"}
_ASKED = {
    "C": {"kind": "coordination", "region": _EVERYWHERE},
    "C_w": {"kind": "coordination", "region": _EVERYWHERE, "bodies": True},
    "C_no_rattlers": {
        "kind": "coordination_without_rattlers", "region": _EVERYWHERE, "least_contacts": HELD, "bodies": True,
    },
    "largest_fragment": {"kind": "largest_fragment"},
}  # fmt: skip


def measured(scene: Scene, record: RunRecord) -> dict[str, Array]:
    """What the engine measures of every sample, shapes (T,) [-]."""
    asked = [{"name": name, "measure": measure} for name, measure in _ASKED.items()]
    radius, mass = np.asarray(record.header.radius), np.asarray(record.header.mass)
    system = {
        "radius": radius.tolist(),
        "mass": mass.tolist(),
        "moment_of_inertia": (0.5 * mass * radius**2).tolist(),
        "gravity": scene["gravity"],
        "domain": scene["domain"],
        "bodies": [{name: body[name] for name in ("name", "material", "shape")} for body in scene["bodies"]],
    }
    names = ("time", "position", "radius", "body_point")
    columns = {name: record[name] for name in names}
    return crossgrain.measure(json.dumps(asked), json.dumps(system), columns)


def course(scene: Scene, record: RunRecord) -> Arrays:
    """Time, temperature, k1(T,t), densities, coordination and the stress on the top wall, shapes (T,), SI."""
    width, height = inner_box(record)
    area = width * height
    top = record.header.bodies.index("top")
    found = measured(scene, record)
    return {
        "time": record["time"],
        "temperature": record["temperature"],
        "k1": record["law_state"][:, 0],
        "nu_geo": np.pi * np.sum(record["radius"] ** 2, axis=1) / area,
        "nu_mat": np.pi * np.sum(np.asarray(record.header.radius) ** 2) / area,
        "sigma_zz": record["body_force"][:, top, 2] / width,
        **found,
    }


def stage_samples(scene: Scene, record: RunRecord) -> dict[str, Indices]:
    """Indices of the samples of each stage, the one at which it begins included, by the stage's name."""
    found: dict[str, Indices] = {}
    begin = int(record.step[0])
    for stage in scene["stages"]:
        end = begin + int(stage["steps"])
        found[stage["name"]] = np.flatnonzero((record.step >= begin) & (record.step <= end)).astype(np.int64)
        begin = end
    return found


# Windows in which coordination may fall while density rises.
WINDOW = 20e-3  # [s]
DROP = -0.02  # [-]
STRIDE = 10e-3  # sampling at which density has to rise [s]
# Coordination is a multiple of 2/N. Its changes are rounded to so many digits: three contacts of 300 disks are 0.02.
DIGITS = 9


def reorganisation(time: Array, density: Array, coordination: Array, stress: Array) -> Numbers:
    """Whether coordination falls while density rises, whether density ever falls, and what the stress does meanwhile.

    `stress` is that of the top wall over the pressure [-]. Times are equally spaced, the last one may be nearer.
    """
    interval = float(np.median(np.diff(time)))
    apart = max(round(WINDOW / interval), 1)
    later = np.arange(len(time))[None, :] - np.arange(len(time))[:, None] >= apart
    rises = density[None, :] > density[:, None]
    change = np.round(coordination[None, :] - coordination[:, None], DIGITS)
    changes = np.where(later & rises, change, np.inf)
    falling = (np.diagonal(change, apart) <= DROP) & (density[apart:] > density[:-apart])
    inside = np.zeros(len(time), dtype=bool)
    for first in np.flatnonzero(falling):
        inside[first : first + apart + 1] = True
    every = max(round(STRIDE / interval), 1)
    rises_by = np.diff(density[::every]).tolist()
    quiet, moved = (float(np.std(stress[which])) if np.any(which) else np.nan for which in (~inside, inside))
    return {
        "C_largest_drop": float(np.min(changes)),
        "C_drop_windows": float(np.sum(falling)),
        "C_windows": float(len(falling)),
        "nu_smallest_rise": float(np.min(rises_by)),
        "stress_std_ratio": moved / quiet if quiet > 0.0 else np.nan,
    }
