"""Claims about the growth of differences between two trajectories."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cross_check.compare.horizons import divergence
from cross_check.compare.samples import BadSample
from cross_check.record import Array

DIAMETER = 2e-3
TIMES = np.linspace(0.0, 1.0, 101)
RATE = 40.0


def pair(distance: Array, particles: int = 5) -> tuple[Array, Array]:
    """Two trajectories whose particle 3 is off by `distance` [m] along x; the others agree."""
    left = np.random.default_rng(26).uniform(size=(len(distance), particles, 3)) * 0.1
    right = np.array(left)
    right[:, 3, 0] += distance
    return left, right


def test_horizons_and_rate_of_an_exponential_are_met_between_samples() -> None:
    start = 1e-12 * DIAMETER
    distance = start * np.exp(RATE * TIMES)
    left = np.zeros((len(TIMES), 1, 3))
    right = left + distance[:, None, None] * np.array([0.6, 0.0, 0.8])
    found = divergence(TIMES, left, right, DIAMETER)
    assert found.fine == pytest.approx(math.log(1e6) / RATE, rel=1e-9)
    assert found.coarse == pytest.approx(math.log(1e10) / RATE, rel=1e-9)
    assert found.deterministic_window == found.fine
    assert found.growth is not None
    assert found.growth.rate == pytest.approx(RATE, rel=1e-9)
    assert found.growth.scatter < 1e-9
    assert (found.growth.begin, found.growth.end) == pytest.approx((0.06, 0.57))


def test_the_largest_is_over_particles_and_rms_shares_it() -> None:
    left, right = pair(np.full(len(TIMES), 3e-9))
    found = divergence(TIMES, left, right, DIAMETER)
    assert found.largest == pytest.approx(3e-9, rel=1e-6)
    assert found.rms == pytest.approx(3e-9 / math.sqrt(5.0), rel=1e-6)
    assert found.fine == 0.0
    assert found.rms_fine is None
    assert not found.in_window().any()


def test_equal_trajectories_have_no_horizon() -> None:
    left, _ = pair(TIMES)
    found = divergence(TIMES, left, left, DIAMETER)
    assert (found.fine, found.coarse, found.growth) == (None, None, None)
    assert found.deterministic_window == 1.0
    assert found.in_window().all()
    assert "a fit needs" in found.growth_note


def test_a_jump_from_zero_passes_at_the_last_sample_of_zero() -> None:
    distance = np.where(TIMES > 0.5, DIAMETER, 0.0)
    found = divergence(TIMES, *pair(distance), DIAMETER)
    assert found.fine == found.coarse == 0.5
    assert found.in_window().sum() == 50


def test_the_first_passing_counts_though_the_difference_shrinks_again() -> None:
    distance = np.full(len(TIMES), 1e-9 * DIAMETER)
    distance[20] = 1e-3 * DIAMETER
    found = divergence(TIMES, *pair(distance), DIAMETER)
    assert found.fine is not None
    assert TIMES[19] < found.fine < TIMES[20]
    assert found.coarse is None


def test_noise_about_the_exponential_is_told_as_scatter_and_error() -> None:
    noise = np.exp(np.random.default_rng(27).normal(0.0, 0.3, len(TIMES)))
    found = divergence(TIMES, *pair(1e-12 * DIAMETER * np.exp(RATE * TIMES) * noise), DIAMETER).growth
    assert found is not None
    assert found.scatter == pytest.approx(0.3, rel=0.3)
    assert abs(found.rate - RATE) < 4.0 * found.standard_error
    assert found.standard_error < 0.05 * RATE


def test_what_cannot_be_compared_is_refused() -> None:
    left, right = pair(TIMES)
    bad = np.array(right)
    bad[4, 2, 1] = math.nan
    with pytest.raises(BadSample, match="right: the position of particle 2 is not a finite number at sample 4"):
        divergence(TIMES, left, bad, DIAMETER)
    with pytest.raises(BadSample, match="5 particles on the left, 4 on the right"):
        divergence(TIMES, left, right[:, :4], DIAMETER)
    with pytest.raises(BadSample, match=r"expected \(100, N, 3\)"):
        divergence(TIMES[:-1], left, right, DIAMETER)
    with pytest.raises(BadSample, match="diameter"):
        divergence(TIMES, left, right, 0.0)
