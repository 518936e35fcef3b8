"""Claims about the plan of the study."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cross_check.sintering import plan, scenes
from cross_check.sintering.plan import Run

# Measured cost of one step, by the number of disks [s].
STEP_COST = {3: 2e-6, 100: 9e-6, 300: 25e-6}
TIME_STEP = 3e-7


@pytest.mark.parametrize("full", [False, True])
def test_every_branch_has_its_parent_before_it_and_no_run_is_there_twice(full: bool) -> None:
    runs = plan.plan(full)
    assert len(set(runs)) == len(runs)
    assert all(run.parent is None or runs.index(run.parent) < runs.index(run) for run in runs)


def test_the_full_form_fits_three_hours_on_two_cores_and_the_quick_one_five_minutes() -> None:
    cost = {
        full: sum(run.work / run.count / TIME_STEP * STEP_COST[run.count] for run in plan.plan(full))
        for full in (False, True)
    }
    assert cost[True] < 0.75 * 2 * 3 * 3600
    assert cost[False] < 0.75 * 2 * 300


def test_the_full_form_has_the_seeds_that_were_asked_for() -> None:
    runs = plan.plan(True)
    for count, seeds in ((100, 8), (300, 2)):
        for pressure in plan.PRESSURES:
            for time in plan.TIMES:
                for test in (plan.COOLED, plan.COMPRESSION, plan.VIBRATION):
                    found = {run.seed for run in runs if run == Run(test, pressure, count, run.seed, time)}
                    assert found == set(range(1, seeds + 1)), (test, pressure, count, time)
    controls = {run.mode for run in runs if run.mode != plan.PLAIN}
    assert controls == set(plan.MODES) - {plan.PLAIN}


def test_seeds_limit_the_samples_of_both_forms() -> None:
    assert {run.seed for run in plan.plan(True, 2)} == {1, 2}
    assert {run.seed for run in plan.plan(False, 3)} == {1, 2, 3}
    assert {run.seed for run in plan.plan(False)} == {1}


def test_overrides_reach_the_case_that_they_are_for() -> None:
    test = Run(plan.COMPRESSION, 10, 100, 5, 1.0, "implicit")
    change = 'model.normal.cooling="implicit"'
    assert test.overrides == ["ensemble.seeds=[5]", change, f"start.{change}", f"start.start.{change}"]
    slow = replace(test, mode="slower_2").overrides
    assert "start.stages.0.end.value=0.2" in slow  # cooling
    assert "start.start.stages.0.end.value=0.4" in slow  # pressing
    assert replace(test, test=plan.FAST, mode=plan.PLAIN).overrides[1].startswith("vary.0.points.0.set=")
    prepared = replace(test, mode="frictional_prep")
    box = prepared.root
    assert box.test == plan.BOX
    assert "pairs.0.values.friction=0.5" in box.overrides
    assert "pairs.0.values.friction=0.5" not in prepared.overrides
    assert "start.start.pairs.0.values.friction=0.5" in prepared.overrides


def test_the_control_without_heat_is_the_frictional_preparation_at_a_temperature_that_is_held() -> None:
    heated, held = (scenes.load(Run(plan.BOX, 10, 100, 1, mode=f"frictional_prep{tail}")) for tail in ("", "_unheated"))
    assert heated["stages"][0] == held["stages"][0]
    ramps = [
        [action for action in scene["stages"][1]["actions"] if action["do"] == "ramp_temperature"]
        for scene in (heated, held)
    ]
    assert ramps[1] == [ramps[0][0] | {"to": held["temperature"]}]
    assert ramps[0] != ramps[1]
    without = [[action for action in scene["stages"][1]["actions"] if "to" not in action] for scene in (heated, held)]
    assert without[0] == without[1] != []


def test_names_of_variants_are_those_of_the_cases() -> None:
    assert Run(plan.BOX, 10, 300, 1).variant == "p=10,N=300"
    assert Run(plan.COOLED, 100, 100, 1, 1e-4).variant == "p=100,N=100,t=1e-4"
    assert Run(plan.THREE, 100, 3, 1).variant == "p=100"
    assert Run(plan.FAST, 10, 100, 1, 0.01, "implicit").name == (
        "sintering-compression/p=10,N=100,t=0.01/seed=1 (implicit, in 0.1 s)"
    )
