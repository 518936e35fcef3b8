"""The checks `finest` and `extrapolated` on values whose error in the step is known."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from cross_check.compare.checks import Bench, compare
from cross_check.compare.outcome import NATIVE, Outcome
from cross_check.compare.quantities import QUANTITIES, Quantity, Undefined
from cross_check.compare.verdicts import AGREE, DIFFER, INCONCLUSIVE, Comparison
from cross_check.engine import Gate
from cross_check.record import Code, Header, RunRecord
from cross_check.reference import closed_forms
from cross_check.scene import Scene
from cross_check.suites import named

SCENE = named("chung-ooi-2").variants[0].scenes[0]
FORM = "hertz_impact.peak_force"
TARGET = float(closed_forms()[FORM](SCENE))
# Deep refinements as `refinements = 1` and `finest = 6` make them.
LEVELS = (0, 1, 4, 5, 6)


def record(level: int) -> RunRecord:
    """A record that knows nothing but its refinement."""
    header = Header(
        source="test", case="c", variant="v", seed=None, refinement=level, code=Code("test", "0", "none"), deck_hash="",
        machine="", wall_time=0.0, time_step=1e-6, steps=1, velocity_time="synchronized", contact_force="exact",
        mass=[1.0], radius=[1.0], bodies=["floor"], gravity=[0.0, 0.0, 0.0],
    )  # fmt: skip
    return RunRecord(header, {})


def judged(
    check: str,
    error: Callable[[float], float],
    bound: float,
    monkeypatch: pytest.MonkeyPatch,
    levels: tuple[int, ...] = LEVELS,
) -> Comparison:
    """The comparison of a native engine whose relative error at the step 2^-k is `error(2^-k)`."""

    def value(_: Scene, run: RunRecord) -> float:
        return TARGET * (1.0 + error(0.5**run.header.refinement))

    monkeypatch.setitem(QUANTITIES, "peak_force", Quantity("peak_force", "N", scalar=value))
    gate = Gate("peak_force", check, FORM, "relative", bound, "the test", None)
    outcomes = {(NATIVE, level): Outcome(NATIVE, SCENE, record(level)) for level in levels}
    (found,) = compare(SCENE, gate, outcomes, ())
    return found


def test_the_finest_run_is_judged_and_its_order_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    found = judged("finest", lambda step: 1e-3 * step, 1e-3, monkeypatch)
    assert found.discrepancy == pytest.approx(1e-3 / 64, rel=1e-9)
    assert found.left.value == pytest.approx(TARGET * (1.0 + 1e-3 / 64), rel=1e-12)
    assert found.right.value == TARGET
    assert found.left.uncertainty == pytest.approx(2.0 * TARGET * 1e-3 / 64, rel=1e-9)
    assert "order 1.00" in found.note
    assert all(f"at step/{2**level}" in found.note for level in LEVELS)
    assert (found.quantity, found.verdict) == ("peak_force", AGREE)
    assert "order 2.00" in judged("finest", lambda step: 1e-3 * step**2, 1.0, monkeypatch).note


def test_coarse_runs_cannot_save_or_spoil_the_finest(monkeypatch: pytest.MonkeyPatch) -> None:
    late = judged("finest", lambda step: 0.0 if step == 1.0 else 1e-3, 1e-4, monkeypatch)
    assert late.verdict == DIFFER
    early = judged("finest", lambda step: 0.1 if step == 1.0 else 0.0, 1e-4, monkeypatch)
    assert early.verdict == AGREE


def test_a_value_that_still_changes_by_more_than_the_bound_is_inconclusive(monkeypatch: pytest.MonkeyPatch) -> None:
    # The last run happens to hit the target while the one before is ten bounds away.
    found = judged("finest", lambda step: 0.0 if step == 0.5**6 else 1e-3, 1e-4, monkeypatch)
    assert (found.discrepancy, found.verdict) == (0.0, INCONCLUSIVE)


def test_extrapolation_takes_away_a_first_order_error(monkeypatch: pytest.MonkeyPatch) -> None:
    found = judged("extrapolated", lambda step: 1e-2 * step, 1e-9, monkeypatch)
    assert found.discrepancy is not None
    assert found.discrepancy < 1e-14
    assert (found.quantity, found.verdict) == ("peak_force, extrapolated", AGREE)
    assert "extrapolated from the last two" in found.note
    assert judged("finest", lambda step: 1e-2 * step, 1e-9, monkeypatch).verdict == DIFFER


def test_extrapolation_keeps_an_error_of_second_order_and_one_that_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    found = judged("extrapolated", lambda step: 1e-2 * step**2, 1.0, monkeypatch)
    # 2 c h^2 - c (2 h)^2 at the finest h
    assert found.discrepancy == pytest.approx(2e-2 * 0.25**6, rel=1e-6)
    wrong = judged("extrapolated", lambda step: 1e-5 + 1e-2 * step, 1e-6, monkeypatch)
    assert wrong.discrepancy == pytest.approx(1e-5, rel=1e-6)
    assert wrong.verdict == DIFFER


def test_an_undefined_quantity_is_not_comparable(monkeypatch: pytest.MonkeyPatch) -> None:
    def undefined(_: float) -> float:
        raise Undefined("the bodies never touch")

    found = judged("finest", undefined, 1.0, monkeypatch)
    assert found.verdict == "not-comparable(the bodies never touch)"


def test_a_bench_reads_the_refinement_that_it_is_asked_for() -> None:
    quantity = Quantity("k", "-", scalar=lambda _, run: float(run.header.refinement))
    outcomes = {(NATIVE, level): Outcome(NATIVE, SCENE, record(level)) for level in LEVELS}
    bench = Bench(SCENE, Gate("k", "finest", FORM, "absolute", 1.0, "the test", None), quantity, outcomes, ())
    assert [bench.value(NATIVE, level) for level in LEVELS] == [0.0, 1.0, 4.0, 5.0, 6.0]
