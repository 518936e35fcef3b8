"""Prescribed paths in decks: formulas of the step are the engine's path, and what a code cannot drive is refused."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cross_check import engine
from cross_check.adapters import ADAPTERS, paths
from cross_check.adapters.interface import NotComparable
from cross_check.scene import Leg, Scene, from_json

ROOT = Path(__file__).parents[3]
# Rounding of sums and products of numbers of order one [in units of the largest value].
ROUNDING = 1e-14


def driven_pair() -> Scene:
    """Two driven spheres, one of which swings and turns, and a free one."""
    return engine.load_case(ROOT / "tests/inputs/good/driven_pair.toml").variants[0].scenes[0]


def with_legs(scene: Scene, change: dict[str, object]) -> Scene:
    """The scene with values of every leg replaced."""

    def changed(leg: Leg) -> Leg:
        return replace(leg, **change)  # pyright: ignore[reportArgumentType]

    drives = tuple(replace(drive, legs=tuple(changed(leg) for leg in drive.legs)) for drive in scene.drives)
    return replace(scene, drives=drives)


def test_formulas_of_the_step_are_the_path_of_the_engine(tmp_path: Path) -> None:
    scene = driven_pair()
    record = engine.run(scene, tmp_path)
    names = {"cos": math.cos, "sin": math.sin}
    for drive in scene.drives:
        found = paths.stages(scene, drive, paths.ZERO)
        for sample, step in enumerate(record.step[1:].tolist(), start=1):
            stage = next(stage for stage in found if step <= stage.last)
            for column, formulas in (
                ("position", stage.place),
                ("velocity", stage.velocity),
                ("angular_velocity", stage.angular_velocity),
            ):
                values = [eval(text, {**names, "step": step}) for text in formulas]  # noqa: S307  our own formulas
                largest = float(np.max(np.abs(record[column][:, drive.particle])))
                assert np.allclose(values, record[column][sample, drive.particle], rtol=0, atol=ROUNDING * largest)


@pytest.mark.parametrize("code", ["liggghts", "lammps"])
def test_a_spin_that_changes_within_a_stage_is_not_comparable(code: str) -> None:
    with pytest.raises(NotComparable, match="angular velocities that are constant over a stage"):
        ADAPTERS[code].deck(driven_pair())
    steady = with_legs(driven_pair(), {"angular_velocity": (0.0, 0.0, 0.0)})
    assert "fix drive_1 driven_1 move variable" in "".join(ADAPTERS[code].deck(steady).files.values())


def test_yade_drives_a_spin_that_changes_within_a_stage() -> None:
    text = ADAPTERS["yade"].deck(driven_pair()).files["scene.py"]
    assert "drive(step)" in text
    compile(text, "scene.py", "exec")


@pytest.mark.parametrize("code", ["liggghts", "lammps"])
def test_free_particles_beside_driven_ones_stay_free(code: str) -> None:
    steady = with_legs(driven_pair(), {"angular_velocity": (0.0, 0.0, 0.0)})
    text = "".join(ADAPTERS[code].deck(steady).files.values())
    assert "group driven id 1 2\n" in text
    assert "fix motion free nve/sphere" in text
    assert text.count("\nrun ") == 2


def test_a_scene_with_paths_survives_json() -> None:
    scene = driven_pair()
    assert from_json(json.loads(scene.to_json())) == scene
