"""What is measured of each run: numbers for the table and arrays for the figures."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np

import crossgrain
from cross_check.record import RecordError, RunRecord
from cross_check.sintering import plan
from cross_check.sintering.bonds import bond_numbers, fragment_numbers
from cross_check.sintering.course import course, reorganisation, stage_samples
from cross_check.sintering.outcome import Arrays, Numbers
from cross_check.sintering.plan import Run
from cross_check.sintering.scenes import Scene
from cross_check.sintering.snapshot import Indices, Snapshot, check, snapshot
from cross_check.sintering.states import Sample, forces, relative_overlaps, state_numbers, stress_trace
from cross_check.sintering.strength import strength_numbers

Measured = tuple[Numbers, Arrays]

# Times of the compression test at which states are kept for figures [s]; bonds are counted at the last one.
SHOWN = (0.005, 0.02, 0.03, 0.035, 0.04)
SURVIVAL = SHOWN[-1]
# Time after the beginning of sintering at which three particles have come to rest [s].
AT_REST = 0.05


@cache
def version() -> str:
    """Hash of all functions that measure: other functions give other numbers."""
    digest = hashlib.blake2b(crossgrain.OBSERVABLES.encode(), digest_size=16)
    for name in ("bonds", "course", "measures", "snapshot", "states", "strength"):
        digest.update(Path(__file__).with_name(f"{name}.py").read_bytes())
    return digest.hexdigest()


def measure(run: Run, scene: Scene, record: RunRecord) -> Measured:
    """The numbers and arrays of one run. Raises RecordError where the record lacks what they need."""
    check(record, run.name)
    names = {stage["name"] for stage in scene["stages"]}
    missing = [name for name in _STAGES[run.test] if name not in names]
    if missing:
        raise RecordError(f"{run.name}: there is no stage {', '.join(missing)} (stages: {', '.join(sorted(names))})")
    return _MEASURES[run.test](run, scene, record)


def sample_of(run: Run, scene: Scene) -> Sample:
    """The constants of a sample: cold k1 of the law, cold friction of the disks, pressure of the variant."""
    coefficients = [scene["pairs"][0].get("friction")]
    for stage in scene["stages"]:
        for action in stage["actions"]:
            if action["do"] == "set_pair" and action["pair"]["between"] == scene["pairs"][0]["between"]:
                coefficients.append(action["pair"].get("friction"))
    return Sample(float(scene["model"]["normal"]["k1"]), float(coefficients[-1] or 0.0), float(run.pressure))


def _box(run: Run, scene: Scene, record: RunRecord) -> Measured:
    """Densities at the ends of the stages, the heating, and reorganisation while the sample is hot."""
    series, stages, sample = course(scene, record), stage_samples(scene, record), sample_of(run, scene)
    numbers = _at_ends(record, stages, sample, ("press", "heat", "sinter")) | _contacts(series, stages)
    heating, hot = stages["heat"], stages["sinter"]
    numbers["nu_first_step"] = float(series["nu_geo"][heating[1]] - series["nu_geo"][heating[0]])
    stress = series["sigma_zz"][hot] / run.pressure
    numbers |= reorganisation(series["time"][hot], series["nu_geo"][hot], series["C"][hot], stress)
    return numbers, series | {"hot_samples": hot}


def _cooled(run: Run, scene: Scene, record: RunRecord) -> Measured:
    """The state at the end of sintering and the one after cool-down and relaxation, with all overlaps and forces."""
    series, sample = course(scene, record), sample_of(run, scene)
    numbers: Numbers = {}
    arrays = dict(series)
    for name, index in (("hot", 0), ("final", -1)):
        state = snapshot(record, index)
        numbers |= _named(name, state_numbers(state, sample)) | _named(name, _contact_numbers(series, index))
        arrays[f"{name}_overlaps"] = relative_overlaps(state)
        arrays[f"{name}_forces"] = forces(state, sample)
        arrays[f"{name}_friction"] = state.friction_force[state.between_particles] / sample.force
    return numbers, arrays


def _compression(run: Run, scene: Scene, record: RunRecord) -> Measured:
    """Stress and density over strain; bonds, attraction and friction 0.04 s after the start and at the end."""
    series, sample = course(scene, record), sample_of(run, scene)
    top = record.header.bodies.index("top")
    height = record["body_point"][:, top, 2] - record["body_point"][:, record.header.bodies.index("bottom"), 2]
    strain = 1.0 - height / height[0]
    numbers = strength_numbers(strain, series["sigma_zz"], series["nu_geo"], sample.pressure)
    before = snapshot(record, 0)
    numbers |= _named("before", state_numbers(before, sample))
    arrays: Arrays = series | {"strain": strain}
    for time in SHOWN:
        state = snapshot(record, _nearest(record, time))
        arrays |= _shown(f"t={time}", state)
        if time == SURVIVAL:
            numbers |= _named("at_survival", state_numbers(state, sample) | bond_numbers(before, state))
    numbers |= _named("end", bond_numbers(before, snapshot(record, -1)))
    return numbers, arrays


def _vibration(run: Run, scene: Scene, record: RunRecord) -> Measured:
    """Fragments after the test."""
    state = snapshot(record, -1)
    numbers = fragment_numbers(state) | _named("final", state_numbers(state, sample_of(run, scene)))
    before = snapshot(record, 0)
    return numbers | bond_numbers(before, state), _shown("end", state)


def _three(run: Run, scene: Scene, record: RunRecord) -> Measured:
    """Three particles: density, and whether a contact opens while they are hot.

    So few particles still bounce as sintering begins; contacts are those that hold AT_REST later. None at all is NaN.
    """
    series, stages, sample = course(scene, record), stage_samples(scene, record), sample_of(run, scene)
    numbers = _at_ends(record, stages, sample, ("press", "heat", "sinter", "relax"))
    hot = stages["sinter"]
    hot = hot[record["time"][hot] >= record["time"][hot[0]] + AT_REST]
    contacts = [{tuple(pair) for pair in np.sort(snapshot(record, int(i)).pair, axis=1).tolist()} for i in hot]
    numbers["contacts_at_rest"] = float(len(contacts[0]))
    numbers["contacts_lost"] = float(max(len(contacts[0] - now) for now in contacts)) if contacts[0] else np.nan
    return numbers, series


_MEASURES: dict[str, Callable[[Run, Scene, RunRecord], Measured]] = {
    plan.BOX: _box,
    plan.COOLED: _cooled,
    plan.COMPRESSION: _compression,
    plan.FAST: _compression,
    plan.VIBRATION: _vibration,
    plan.THREE: _three,
}
_STAGES = {
    plan.BOX: ("press", "heat", "sinter"),
    plan.COOLED: ("cool", "relax"),
    plan.COMPRESSION: ("compress",),
    plan.FAST: ("compress",),
    plan.VIBRATION: ("vibrate",),
    plan.THREE: ("press", "heat", "sinter", "cool", "relax"),
}


def _at_ends(record: RunRecord, stages: dict[str, Indices], sample: Sample, names: tuple[str, ...]) -> Numbers:
    found: Numbers = {}
    for name in names:
        found |= _named(name, state_numbers(snapshot(record, int(stages[name][-1])), sample))
    return found


def _contacts(series: Arrays, stages: dict[str, Indices]) -> Numbers:
    found: Numbers = {}
    for name, samples in stages.items():
        found |= _named(name, _contact_numbers(series, int(samples[-1])))
    return found


def _contact_numbers(series: Arrays, index: int) -> Numbers:
    return {name: float(series[name][index]) for name in ("C", "C_w", "C_no_rattlers", "largest_fragment")}


def _named(prefix: str, numbers: Numbers) -> Numbers:
    return {f"{prefix}_{name}": value for name, value in numbers.items()}


def _nearest(record: RunRecord, time: float) -> int:
    """The sample nearest to a time since the start of the run [s]."""
    return int(np.argmin(np.abs(record["time"] - record["time"][0] - time)))


def _shown(name: str, state: Snapshot) -> Arrays:
    """What a picture of a state needs."""
    both = state.between_particles
    return {
        f"{name} time": np.array(state.time),
        f"{name} box": np.array([*state.corner, *state.box]),
        f"{name} position": state.position,
        f"{name} radius": state.radius,
        f"{name} stress": stress_trace(state),
        f"{name} pair": state.pair[both],
        f"{name} force": state.elastic[both],
        f"{name} friction": state.friction_force[both],
    }
