"""Claims about the targets: each can miss, values follow from the runs by rule, and the plan holds what they need."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import made_up_runs
import numpy as np
import pytest

import crossgrain
from cross_check.compare.verdicts import AGREE, DIFFER
from cross_check.sintering import judgement, plan
from cross_check.sintering.errors import StudyError
from cross_check.sintering.measures import measure
from cross_check.sintering.outcome import Arrays, Numbers, Outcome
from cross_check.sintering.plan import Run
from cross_check.sintering.shapes import SHAPES
from cross_check.sintering.study import Sample, Study
from cross_check.sintering.targets import FAILED, LEFT_OUT, MET, MISSED, REPORTED, Target, judge, targets

TABLE = targets()
GATED = [target for target in TABLE if target.gated]


@cache
def measured(test: str) -> tuple[Numbers, Arrays]:
    """All numbers and arrays of a made-up run of a test."""
    small = test == plan.THREE
    time = None if test in (plan.BOX, plan.THREE) else 1.0
    run = Run(test, 10, 3 if small else 100, 1, time)
    scene = made_up_runs.scene(run)
    return measure(run, scene, made_up_runs.simulate(scene, Path(), Path(), []))


def whole(full: bool, seeds: int | None = None) -> Study:
    """A study in which every run of a test gave the same numbers."""
    outcomes = {run: Outcome(run, *measured(run.test)) for run in plan.plan(full, seeds)}
    return Study(outcomes, full, made_up_runs.LAW, seeds)


@pytest.mark.parametrize("target", GATED, ids=lambda target: target.name)
def test_every_threshold_can_be_missed(target: Target) -> None:
    limits = [limit for limit in (target.low, target.high) if limit is not None]
    assert not target.keeps(math.nan)
    for limit in limits:
        beyond = limit - 1e-3 if limit == target.low else limit + 1e-3
        assert not target.keeps(beyond)
        assert target.outside(beyond) == pytest.approx(1e-3)
        assert target.keeps(limit) != target.strict
    assert target.low is None or target.high is None or target.keeps(0.5 * (target.low + target.high))
    assert target.threshold


def test_the_plan_holds_what_every_target_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(crossgrain, "sintering_stiffness", made_up_runs.softening, raising=False)
    study = whole(full=True)
    rows = [judge(target, study) for target in TABLE]
    assert [row.target.name for row in rows if row.verdict in (FAILED, LEFT_OUT)] == []
    assert {row.verdict for row in rows} == {MET, MISSED, REPORTED}
    quick = [judge(target, whole(full=False)) for target in TABLE]
    assert [row.target.name for row in quick if row.verdict == FAILED] == []
    assert all(row.verdict != LEFT_OUT for row in quick if row.target.quick and row.target.sample.count == 100)


def test_fewer_seeds_than_asked_for_leave_a_target_open_and_missing_ones_fail_it() -> None:
    target = next(target for target in GATED if target.id == "T17-rank")
    assert target.seeds == 8
    assert judge(target, whole(full=True, seeds=3)).verdict == LEFT_OUT
    study = whole(full=True)
    lost = {run: outcome for run, outcome in study.outcomes.items() if run.seed != 8}
    assert judge(target, Study(lost, True, {})).verdict == FAILED


def series(values: dict[tuple[int, float, int], float], quantity: str = "final_nu_geo") -> Study:
    """A study of cooled samples: the quantity by pressure, sintering time and seed."""
    outcomes: dict[Run, Outcome] = {}
    for (pressure, time, seed), value in values.items():
        run = Run(plan.COOLED, pressure, 100, seed, time)
        outcomes[run] = Outcome(run, {quantity: value})
    return Study(outcomes, True, {})


def value(study: Study, shape: str, sample: Sample | None = None, **asked: Any) -> tuple[float, list[float]]:
    found = SHAPES[shape](study, sample or Sample(10, 100), {"quantity": "cooled.final_nu_geo", **asked})
    return found.value, found.seeds


TIMES = [0.01, 0.05, 1.0]
MEANS_RISE_SEEDS_DO_NOT = series(
    {(10, t, s): v for t, pair in zip(TIMES, [(1, 2), (4, 1), (3, 6)], strict=True) for s, v in enumerate(pair)}
)


def test_a_growth_is_the_smallest_step_of_the_seed_mean() -> None:
    found, seeds = value(MEANS_RISE_SEEDS_DO_NOT, "growth", times=TIMES)
    assert found == pytest.approx(1.0)
    assert seeds == [-1.0, -1.0]
    assert value(MEANS_RISE_SEEDS_DO_NOT, "growth", times=TIMES, falls=True)[0] == pytest.approx(-2.0)


def test_a_level_over_several_times_is_the_worst_of_them() -> None:
    assert value(MEANS_RISE_SEEDS_DO_NOT, "level", times=TIMES, worst="max") == (4.5, [4.0, 6.0])
    assert value(MEANS_RISE_SEEDS_DO_NOT, "level", times=TIMES, worst="min") == (1.5, [1.0, 1.0])


def test_ratios_and_differences_are_of_means_not_means_of_ratios() -> None:
    study = series({(10, 1.0, 1): 1.0, (10, 1.0, 2): 3.0, (100, 1.0, 1): 4.0, (100, 1.0, 2): 4.0})
    change: dict[str, Any] = {"of": {"pressure": 100}, "to": {"pressure": 10}}
    assert value(study, "ratio", **change) == (2.0, [4.0, 4.0 / 3.0])
    assert value(study, "difference", **change) == (2.0, [3.0, 1.0])
    reverse: dict[str, Any] = {"of": {"pressure": 10}, "to": {"pressure": 100}, "size": True}
    assert value(study, "difference", **reverse)[0] == 2.0
    nothing = series({(10, 1.0, 1): 0.0, (100, 1.0, 1): 4.0})
    assert math.isnan(value(nothing, "ratio", **change)[0])


def test_modes_are_compared_over_the_seeds_that_both_have() -> None:
    def cooled(count: int, seed: int, mode: str, density: float) -> Outcome:
        return Outcome(Run(plan.COOLED, 10, count, seed, 1.0, mode), {"final_nu_geo": density})

    made = [cooled(100, 1, plan.PLAIN, 1.0), cooled(100, 2, plan.PLAIN, 3.0), cooled(100, 1, "implicit", 1.5)]
    study = Study({outcome.run: outcome for outcome in (*made, cooled(300, 1, plan.PLAIN, 8.0))}, True, {})
    assert value(study, "difference", of={"mode": "implicit"}, to={"mode": plan.PLAIN}) == (0.5, [0.5])
    sizes: dict[str, Any] = {"of": {"count": 300}, "to": {"count": 100}}
    assert value(study, "ratio", **sizes)[0] == 4.0  # other packings: all seeds count


def test_a_rank_is_that_of_the_means_and_a_fall_the_steepest_factor() -> None:
    up = series({(10, t, 1): v for t, v in zip(TIMES, [1.0, 2.0, 3.0], strict=True)})
    down = series({(10, t, 1): v for t, v in zip(TIMES, [3.0, 2.0, 4.0], strict=True)})
    assert value(up, "rank", times=TIMES)[0] == pytest.approx(1.0)
    assert value(down, "rank", times=TIMES)[0] == pytest.approx(0.5)
    assert value(up, "steepest_fall", times=TIMES)[0] < 1.0
    assert value(down, "steepest_fall", times=TIMES)[0] == pytest.approx(1.5)


def test_gains_and_jumps_compare_the_pressures() -> None:
    study = series({(10, 0.01, 1): 1.0, (10, 1.0, 1): 3.0, (100, 0.01, 1): 10.0, (100, 1.0, 1): 40.0})
    assert value(study, "gain_ratio", times=[1.0], base=0.01)[0] == pytest.approx(15.0)
    times: dict[str, Any] = {"from": 0.01, "until": 1.0}
    assert value(study, "jump_ratio", **times)[0] == pytest.approx(0.75)


def test_the_early_failure_is_not_the_largest_stress_of_loose_grains() -> None:
    run = Run(plan.COMPRESSION, 10, 100, 1, 1.0)
    arrays = {"strain": np.array([0.0, 0.002, 0.009, 0.05]), "sigma_zz": np.array([10.0, 40.0, 20.0, 50.0])}
    study = Study({run: Outcome(run, {"failure_strain": 0.05}, arrays)}, True, {})
    assert study.values("early_failure_strain", Sample(10, 100)) == {1: 0.002}


def test_heat_alone_is_what_the_control_without_heat_leaves() -> None:
    def box(mode: str, cold: float, warm: float) -> Outcome:
        run = Run(plan.BOX, 10, 100, 1, mode=mode)
        return Outcome(run, {"press_nu_geo": cold, "heat_nu_geo": warm})

    cooled = Run(plan.COOLED, 10, 100, 1, 1.0, "frictional_prep")
    boxes = (box("frictional_prep", 0.78, 0.79), box("frictional_prep_unheated", 0.78, 0.788))
    outcomes = {outcome.run: outcome for outcome in (*boxes, Outcome(cooled, {"final_nu_geo": 0.82}))}
    study, sample = Study(outcomes, True, {}), Sample(10, 100, mode="frictional_prep")
    assert study.values("heating_share", sample)[1] == pytest.approx(0.25)
    assert study.values("heat_alone", sample)[1] == pytest.approx(0.05)


def test_a_deviation_is_the_largest_of_all_seeds_and_times() -> None:
    study = series({(10, 0.01, 1): 1.0, (10, 1.0, 1): 2.0, (10, 0.01, 2): 1.0, (10, 1.0, 2): 2.1})
    assert value(study, "deviation", values={"0.01": 1.0, "1.0": 2.0})[0] == pytest.approx(0.05)


def test_a_row_judged_on_every_seed_misses_for_one() -> None:
    study = series({(10, 1.0, 1): 1.0, (10, 1.0, 2): 3.0, (10, 1.0, 3): 1.0})
    words: dict[str, Any] = {"id": "x", "claim": "", "paper": "", "threshold": "below 2", "shape": "level", "unit": "-"}
    target = Target(**words, sample=Sample(10, 100), high=2.0, asked={"quantity": "cooled.final_nu_geo"})
    assert judge(target, study).verdict == MET
    each = Target(**words, sample=Sample(10, 100), high=2.0, each=True, asked={"quantity": "cooled.final_nu_geo"})
    row = judge(each, study)
    assert row.verdict == MISSED
    assert row.kept_by == 2
    assert row.spread == pytest.approx(np.std([1, 3, 1], ddof=1))


def test_verdicts_follow_the_rows_and_a_vanished_row_is_not_as_expected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(crossgrain, "sintering_stiffness", made_up_runs.softening, raising=False)
    rows = [judge(target, whole(full=True)) for target in TABLE]
    found = judgement.comparisons(rows, full=True)
    words = {MET: AGREE, MISSED: DIFFER}
    assert [item.verdict for item in found] == [words[row.verdict] for row in rows if row.target.gated]
    assert all(item.expected for item in found)
    gated = next(row for row in rows if row.target.gated)
    fewer = judgement.comparisons([row for row in rows if row is not gated], full=True)
    assert any(item.check == "expectation" and not item.as_expected for item in fewer)


def test_unknown_quantities_are_refused_with_what_is_known() -> None:
    with pytest.raises(StudyError, match=r"cooled\.colour: no such number \(known: final_nu_geo\)"):
        value(MEANS_RISE_SEEDS_DO_NOT, "level", Sample(10, 100), quantity="cooled.colour")
    with pytest.raises(StudyError, match="oven: no such quantity"):
        value(MEANS_RISE_SEEDS_DO_NOT, "level", quantity="oven")
