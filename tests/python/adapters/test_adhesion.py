"""Adhesive laws in the real codes against their mirrors: whole histories of force and torque."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cross_check.adapters import ADAPTERS
from cross_check.record import RunRecord

from . import contact_scenes, scenes
from .test_friction import check_history, run_all

Records = dict[str, RunRecord]
NAMES = [(code, name) for code in ADAPTERS for name in contact_scenes.adhesive_scenes(code)]


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Records]:
    """Every scene of every installed code."""
    return {
        code: run_all(code, contact_scenes.adhesive_scenes(code), tmp_path_factory)
        for code, adapter in ADAPTERS.items()
        if adapter.installed() is not None
    }


@pytest.mark.parametrize(("code", "name"), NAMES)
def test_force_and_torque_histories_are_the_mirror(
    code: str, name: str, records: dict[str, Records], tmp_path: Path
) -> None:
    if code not in records:
        pytest.skip(f"{code} is not installed")
    check_history(records[code][name], contact_scenes.adhesive_scenes(code)[name], code, tmp_path)


@pytest.mark.parametrize("code", ["yade", "lammps"])
def test_dmt_pulls_off_at_two_pi_work_radius(code: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    """The attraction is hardest at the last touch; Hertz takes 1e-3 of it off at the last sample, 0.4 um deep."""
    whole = scenes.pair(restitution=1.0)
    model = replace(whole.model, normal=replace(whole.model.normal, law="dmt"))
    whole = contact_scenes.with_laws(whole, model, "pull-off", work_of_adhesion=0.5)
    record = run_all(code, {"pull-off": whole}, tmp_path_factory)["pull-off"]
    check = 2 * math.pi * 0.5 * (5e-3 * 3e-3 / 8e-3)
    assert float(np.max(record["force"][:, 0, 0])) == pytest.approx(check, rel=0.05)
