"""The hysteretic law in LIGGGHTS and YADE against their mirrors: loading, unloading, minimum, reloading."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from cross_check import engine
from cross_check.adapters import ADAPTERS
from cross_check.record import RunRecord

from . import contact_scenes
from .test_friction import check_history, run_all

# Of the peak; the branch is chosen by comparisons, which amplify no rounding here.
TOLERANCE = 1e-10
SCENES = contact_scenes.luding_scenes()


@pytest.fixture(scope="module", params=["liggghts", "yade"])
def code(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def records(code: str, tmp_path_factory: pytest.TempPathFactory) -> dict[str, RunRecord]:
    return run_all(code, SCENES, tmp_path_factory)


@pytest.mark.parametrize("name", [name for name in SCENES if name != "floor/graze"])
def test_force_history_is_the_mirror(code: str, name: str, records: dict[str, RunRecord], tmp_path: Path) -> None:
    check_history(records[name], SCENES[name], code, tmp_path, TOLERANCE)


def test_a_wall_of_yade_is_elastic(code: str, records: dict[str, RunRecord]) -> None:
    velocity = records["floor"].synchronized_velocity()[:, 0, 2]
    rebound = -float(velocity[-1] / velocity[0])
    if code == "yade":
        assert rebound == pytest.approx(1.0, abs=1e-6)
    else:
        assert rebound < 0.9


def test_a_wall_of_yade_has_no_force_while_the_overlap_stays_below_its_first(
    code: str, records: dict[str, RunRecord], tmp_path: Path
) -> None:
    record = records["floor/graze"]
    overlap = 5e-3 - record["position"][:, 0, 2]
    touching = np.flatnonzero(overlap > 0.0)
    assert len(touching) == 2
    assert overlap[touching[0]] > overlap[touching[1]]
    mirror = engine.run(ADAPTERS[code].mirror(SCENES["floor/graze"]), tmp_path / "mirror")
    assert np.all(record["force"][touching] == 0.0) == (code == "yade")
    assert np.all(mirror["force"][touching] == 0.0) == (code == "yade")


def test_mirrors_follow_the_rule_of_the_code(code: str) -> None:
    mirror = ADAPTERS[code].mirror(SCENES["part"]).mirror
    assert mirror.hysteresis == {"liggghts": "old_stiffness", "yade": "luding_pm"}[code]
