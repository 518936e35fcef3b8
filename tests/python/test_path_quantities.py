"""Observables of contacts along paths, on records made by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cross_check.adapters import ADAPTERS
from cross_check.compare.oblique import torque_history
from cross_check.compare.path_quantities import tangential_body_change, tangential_length_change
from cross_check.compare.quantity import Undefined
from cross_check.engine import load_case
from cross_check.record import Code, Header, RunRecord
from cross_check.scene import Scene
from cross_check.suites import FOLDER
from reference.analytic import rigid_turn

SCENE = load_case(FOLDER / "rigid_turn.toml").variants[0].scenes[0]
CODE = Code("made", "by hand", "-")
FIRST = SCENE.steps - SCENE.drives[0].legs[-1].steps


def record(scene: Scene, force_after: tuple[float, float, float], first: int = FIRST) -> RunRecord:
    """Two samples, before and after a quarter turn about z; before it a tangential force of 2 N acts along y."""
    header = Header(
        "native", scene.case, "", None, 0, CODE, "", "-", 0.0, scene.time_step, scene.steps, "synchronized", "exact",
        [1.0, 1.0], [5e-3, 3e-3], [], [0.0, 0.0, 0.0],
    )  # fmt: skip
    apart = np.array([[[0.0, 0.0, 0.0], [7.8e-3, 0.0, 0.0]], [[0.0, 0.0, 0.0], [0.0, 7.8e-3, 0.0]]])
    normals = np.array([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    forces = 5.0 * normals + np.array([[0.0, 2.0, 0.0], force_after])
    columns = {
        "step": np.array([first, scene.steps]),
        "position": apart,
        "force": np.stack([forces, -forces], axis=1),
        "torque": np.ones((2, 2, 3)),
    }
    return RunRecord(header, columns)


def test_a_force_that_turns_rigidly_does_not_change() -> None:
    turned = record(SCENE, (-2.0, 0.0, 0.0))
    assert abs(tangential_length_change(SCENE, turned)) < 1e-15
    assert tangential_body_change(SCENE, turned) < 1e-15


def test_a_force_that_shrinks_and_turns_in_the_body_changes_by_both() -> None:
    turned = record(SCENE, (-1.0, 0.0, 1.0))
    assert tangential_length_change(SCENE, turned) == pytest.approx(math.sqrt(0.5) - 1.0)
    assert tangential_body_change(SCENE, turned) == pytest.approx(math.sqrt(0.5))


def test_a_record_without_the_beginning_of_the_stage_defines_no_change() -> None:
    with pytest.raises(Undefined, match="no sample at the beginning"):
        tangential_length_change(SCENE, record(SCENE, (-2.0, 0.0, 0.0), first=FIRST + 1))


def test_full_radii_in_the_slip_velocity_define_no_change() -> None:
    mirror = ADAPTERS["lammps"].mirror(SCENE)
    with pytest.raises(Undefined, match="slides while it turns"):
        tangential_length_change(mirror, record(mirror, (-2.0, 0.0, 0.0)))


def test_the_closed_form_follows_the_rotation_of_each_code() -> None:
    step = 0.5 * math.pi / 10_000
    size = 0.5 * 10_000 * step * step
    for code, share in (("liggghts", -1.0), ("yade", 1.0), ("lammps", 0.0)):
        mirror = ADAPTERS[code].mirror(SCENE)
        assert rigid_turn.tangential_length_change(mirror) == pytest.approx(share * size, rel=1e-12)
    assert rigid_turn.tangential_length_change(SCENE) == 0.0


def test_torques_are_those_of_the_record() -> None:
    made = record(SCENE, (-2.0, 0.0, 0.0))
    assert torque_history(replace(SCENE), made) is made["torque"]
