"""Claims about two one-sided tests, their errors and their power."""

# pyright: reportUnknownMemberType=false
# scipy leaves the results of its tests untyped.

from __future__ import annotations

import math
from statistics import NormalDist
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy import stats

from cross_check.compare.equivalence import LEVEL, Equivalence, equivalence, needed, power
from cross_check.compare.quantity import Undefined
from cross_check.compare.samples import BadSample, sample, welch
from cross_check.compare.verdicts import AGREE, DIFFER, INCONCLUSIVE

VALUES = st.lists(st.floats(-10.0, 10.0), min_size=2, max_size=8)
MARGINS = st.floats(0.05, 20.0)
RANK = {DIFFER: 0, INCONCLUSIVE: 1, AGREE: 2}
FEW = settings(max_examples=50, deadline=None)
ENSEMBLES = 4000
ERROR = 3.0 * math.sqrt(0.05 * 0.95 / ENSEMBLES)  # three standard errors of a simulated rate of 5 %


def scatter(result: Equivalence) -> float:
    return math.hypot(result.left.standard_error, result.right.standard_error)


def test_p_values_and_interval_are_those_of_scipys_welch_test() -> None:
    left, right, margin = np.array([0.61, 0.60, 0.62, 0.59]), np.array([0.605, 0.607, 0.606, 0.604, 0.63]), 0.02
    found = equivalence(left, right, margin)
    lower: Any = stats.ttest_ind(left + margin, right, equal_var=False, alternative="greater")
    upper: Any = stats.ttest_ind(left - margin, right, equal_var=False, alternative="less")
    both: Any = stats.ttest_ind(left, right, equal_var=False)
    assert found.p_lower == pytest.approx(lower.pvalue, rel=1e-10)
    assert found.p_upper == pytest.approx(upper.pvalue, rel=1e-10)
    assert found.degrees_of_freedom == pytest.approx(both.df, rel=1e-10)
    interval = both.confidence_interval(LEVEL)
    assert found.interval == pytest.approx((interval.low, interval.high), rel=1e-10)
    changed = welch(sample(left, "left"), sample(right, "right")).p_changed()
    assert changed == pytest.approx(both.pvalue, rel=1e-10)


def test_each_verdict_is_reached() -> None:
    base = np.array([-0.1, 0.0, 0.1, 0.05, -0.05])
    assert equivalence(base, base + 0.02, 0.5).verdict == AGREE
    assert equivalence(base, base + 2.0, 0.5).verdict == DIFFER
    assert equivalence(base, base + 0.5, 0.5).verdict == INCONCLUSIVE
    assert equivalence(10.0 * base, 10.0 * base, 0.5).verdict == INCONCLUSIVE


@FEW
@given(VALUES, VALUES, MARGINS)
def test_exchange_turns_the_difference_and_nothing_else(left: list[float], right: list[float], margin: float) -> None:
    one, other = equivalence(left, right, margin), equivalence(right, left, margin)
    assert one.verdict == other.verdict
    assert one.difference == -other.difference
    assert one.interval == (-other.interval[1], -other.interval[0])
    assert one.p_lower == pytest.approx(other.p_upper, rel=1e-9)
    assert one.power == pytest.approx(other.power, rel=1e-9)
    assert one.needed == other.needed


@FEW
@given(VALUES, VALUES, MARGINS, st.floats(-100.0, 100.0))
def test_a_shift_of_both_sides_changes_nothing(
    left: list[float], right: list[float], margin: float, shift: float
) -> None:
    one = equivalence(left, right, margin)
    assume(scatter(one) > 1e-6)  # below, the rounding of the shifted values is a scatter of its own
    other = equivalence(np.array(left) + shift, np.array(right) + shift, margin)
    assert other.interval == pytest.approx(one.interval, abs=1e-6)
    assert other.p_lower == pytest.approx(one.p_lower, abs=1e-6)
    assert other.power == pytest.approx(one.power, abs=1e-6)


@FEW
@given(VALUES, VALUES, MARGINS, st.floats(1.0, 10.0))
def test_a_wider_margin_never_speaks_against_agreement(
    left: list[float], right: list[float], margin: float, factor: float
) -> None:
    narrow, wide = equivalence(left, right, margin), equivalence(left, right, margin * factor)
    assert RANK[wide.verdict] >= RANK[narrow.verdict]
    assert max(wide.p_lower, wide.p_upper) <= max(narrow.p_lower, narrow.p_upper)
    assert wide.power >= narrow.power - 1e-12
    assert wide.needed <= narrow.needed


@FEW
@given(VALUES, VALUES, MARGINS)
def test_verdicts_are_read_off_the_interval(left: list[float], right: list[float], margin: float) -> None:
    found = equivalence(left, right, margin)
    low, high = found.interval
    assume(min(abs(abs(low) - margin), abs(abs(high) - margin)) > 1e-9)
    inside, outside = -margin < low and high < margin, low > margin or high < -margin
    assert found.verdict == (AGREE if inside else DIFFER if outside else INCONCLUSIVE)


@pytest.mark.parametrize(("size", "deviations"), [(3, (1.0, 1.0)), (5, (1.0, 1.0)), (5, (1.0, 3.0)), (10, (1.0, 2.0))])
def test_both_errors_at_the_margin_are_at_most_five_percent(size: int, deviations: tuple[float, float]) -> None:
    generator, margin = np.random.default_rng(20), 3.0
    left = generator.normal(0.0, deviations[0], (ENSEMBLES, size))
    right = generator.normal(margin, deviations[1], (ENSEMBLES, size))
    found = [interval(*pair) for pair in zip(left, right, strict=True)]
    agree = sum(-margin < low and high < margin for low, high in found) / ENSEMBLES
    differ = sum(low > margin or high < -margin for low, high in found) / ENSEMBLES
    assert agree <= 0.05 + ERROR
    assert differ <= 0.05 + ERROR
    assert differ > 0.02  # the test decides where it may


def interval(left: np.ndarray, right: np.ndarray) -> tuple[float, float]:
    return welch(sample(left, "left"), sample(right, "right")).interval(LEVEL)


@pytest.mark.parametrize(
    ("sizes", "deviations", "margin"),
    [((3, 3), (1.0, 1.0), 2.0), ((5, 5), (1.0, 3.0), 4.0), ((10, 4), (1.0, 0.5), 1.2), ((5, 5), (1.0, 1.0), 2.0)],
)
def test_power_is_the_share_of_agreement_in_a_simulation(
    sizes: tuple[int, int], deviations: tuple[float, float], margin: float
) -> None:
    generator = np.random.default_rng(21)
    left = generator.normal(0.0, deviations[0], (ENSEMBLES, sizes[0]))
    right = generator.normal(0.0, deviations[1], (ENSEMBLES, sizes[1]))
    found = [interval(*pair) for pair in zip(left, right, strict=True)]
    share = sum(-margin < low and high < margin for low, high in found) / ENSEMBLES
    expected = power(*deviations, *sizes, margin)
    assert 0.2 < expected < 0.99
    assert share == pytest.approx(expected, abs=3.0 * math.sqrt(expected * (1.0 - expected) / ENSEMBLES))


def test_power_of_large_samples_is_that_of_known_variances() -> None:
    normal = NormalDist()
    expected = 2.0 * normal.cdf(3.0 - normal.inv_cdf(0.95)) - 1.0
    assert power(1.0, 1.0, 20000, 20000, 3.0 * math.sqrt(2.0 / 20000)) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize(("deviations", "margin"), [((1.0, 1.0), 2.0), ((1.0, 3.0), 1.5), ((0.0, 1.0), 0.9)])
def test_needed_is_the_first_size_with_the_wanted_power(deviations: tuple[float, float], margin: float) -> None:
    size = needed(*deviations, margin)
    assert power(*deviations, size, size, margin) >= 0.9
    assert power(*deviations, size - 1, size - 1, margin) < 0.9


def test_needed_goes_on_smoothly_where_the_normal_approximation_begins() -> None:
    sizes = [needed(1.0, 1.0, margin) for margin in (0.148, 0.147, 0.146)]
    assert sizes[0] < 1000 < sizes[-1]
    assert sizes[-1] - sizes[0] < 0.04 * sizes[0]
    assert needed(1.0, 1.0, 1e-300) == 10**15


def test_an_ensemble_of_one_is_refused() -> None:
    with pytest.raises(Undefined, match="an ensemble of one has no scatter"):
        equivalence([0.6], [0.6, 0.61], 0.01)
    with pytest.raises(Undefined, match="right is an ensemble without members"):
        equivalence([0.6, 0.61], [], 0.01)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_what_is_not_a_finite_number_is_refused(bad: float) -> None:
    with pytest.raises(BadSample, match=r"right: value 1 is (nan|inf), expected finite numbers"):
        equivalence([0.6, 0.61], [0.6, bad], 0.01)


@pytest.mark.parametrize("margin", [0.0, -0.1, math.nan, math.inf])
def test_a_margin_must_be_positive(margin: float) -> None:
    with pytest.raises(BadSample, match="expected a positive finite number"):
        equivalence([0.6, 0.61], [0.6, 0.61], margin)


def test_a_table_is_no_sample() -> None:
    with pytest.raises(BadSample, match=r"left: values of shape \(1, 2\)"):
        equivalence([[0.6, 0.61]], [0.6, 0.61], 0.1)


def test_values_without_scatter_are_compared_as_they_stand_and_the_note_says_so() -> None:
    same, other = [0.1, 0.1, 0.1], [0.3, 0.3, 0.3]  # numpy's mean of the first is not 0.1
    found = equivalence(same, same, 0.01)
    assert (found.verdict, found.interval, found.power, found.needed) == (AGREE, (0.0, 0.0), 1.0, 2)
    assert "depends on the seed" in found.note
    assert "depends on the seed" in found.describe()
    assert equivalence(same, other, 0.01).verdict == DIFFER
    assert equivalence([0.0, 0.0], [1.0, 1.0], 1.0).verdict == INCONCLUSIVE
    assert equivalence(same, [0.1, 0.1, 0.1001], 0.01).note == ""


def test_the_description_holds_everything_a_reader_judges_by() -> None:
    found = equivalence([0.60, 0.61, 0.62], [0.605, 0.61, 0.615], 0.02)
    text = found.describe("-")
    ends = (f"power {found.power:.2f}", f"{found.needed} seeds per side for 0.9")
    for part in ("standard deviation 0.01, n 3", "90% interval", "margin 0.02", *ends):
        assert part in text
