"""Friction in the real codes against their mirrors: whole histories of force and torque."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from cross_check import engine
from cross_check.adapters import ADAPTERS
from cross_check.record import RunRecord
from cross_check.scene import Scene

from . import contact_scenes, scenes

# Largest difference of a force or torque from the mirror in units of the peak: rounding of a whole collision.
TOLERANCE = 1e-11
TIME_LIMIT = 60.0
SCENES = contact_scenes.frictional_scenes()
Records = dict[str, RunRecord]


def run_all(code: str, wanted: dict[str, Scene], tmp_path_factory: pytest.TempPathFactory) -> Records:
    """All scenes run by one code, in one batch."""
    adapter = ADAPTERS[code]
    found = adapter.installed()
    if found is None or found.version not in adapter.proved_versions:
        pytest.skip(f"{code} is not installed in a proved version")
    decks = [adapter.deck(whole) for whole in wanted.values()]
    results = adapter.run(decks, tmp_path_factory.mktemp(code), TIME_LIMIT)
    for result in results:
        assert isinstance(result, RunRecord), str(result)
    return {name: result for name, result in zip(wanted, results, strict=True) if isinstance(result, RunRecord)}


def check_history(record: RunRecord, whole: Scene, code: str, folder: Path, tolerance: float = TOLERANCE) -> None:
    """Compares forces and torques with the mirror of the code, in units of the peaks."""
    mirror = engine.run(ADAPTERS[code].mirror(whole), folder / "mirror")
    for name in ("force", "torque"):
        peak = float(np.abs(mirror[name]).max())
        assert peak > 0 or name == "torque"
        worst = float(np.abs(record[name] - mirror[name]).max()) / (peak or 1.0)
        print(f"{code} {whole.variant}: {name} {worst:.1e} of the peak")  # noqa: T201
        assert worst < tolerance


@pytest.fixture(scope="module", params=list(ADAPTERS))
def code(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def records(code: str, tmp_path_factory: pytest.TempPathFactory) -> Records:
    return run_all(code, SCENES, tmp_path_factory)


@pytest.mark.parametrize("name", list(SCENES))
def test_force_and_torque_histories_are_the_mirror(code: str, records: Records, name: str, tmp_path: Path) -> None:
    check_history(records[name], SCENES[name], code, tmp_path)


@pytest.mark.parametrize("history", ["displacement", "force", "force_rescaled"])
def test_lammps_remembers_what_the_scene_says(
    history: str, tmp_path: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    whole = contact_scenes.mindlin(scenes.oblique_pair(), 0.9, f"mindlin/{history}", history)
    record = run_all("lammps", {history: whole}, tmp_path_factory)[history]
    check_history(record, whole, "lammps", tmp_path)
