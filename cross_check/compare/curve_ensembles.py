"""Ensembles of curves over time: the largest difference of their means, with limits from resampled seeds.

With d(t) = mean of the left curves - mean of the right curves and D(t) its expectation, the question is whether
max |D(t)| is below a margin. Whole curves are drawn again from each ensemble with replacement (a bootstrap of seeds, so
that the correlation along a curve is kept), which gives samples e(t) of the error of d(t). The limits are

    high = 95 % quantile of max |d + e|      `agree`  if high < margin
    low  = max |d| - 95 % quantile of max |e|      `differ` if low > margin

max |d + e| tends to be larger than max |d|, which itself tends to be larger than max |D|: that makes `high` cautious.
For the same reason the 5 % quantile of max |d + e| would call equal curves different far too often; `low` is the limit
of a band d(t) +- c that holds D(t) at all times at once with a probability of 95 %.

Few seeds: a bootstrap of n values underestimates their variance by (n - 1)/n and takes the normal quantile where
Student's belongs. Errors are enlarged by both factors, with Welch's degrees of freedom at each time ("expanded
percentile": T. C. Hesterberg, The American Statistician 69 (2015) 371-386, section 5).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtri, stdtrit

from cross_check.compare.quantity import Undefined
from cross_check.compare.samples import NO_SCATTER, BadSample
from cross_check.compare.verdicts import AGREE, DIFFER, INCONCLUSIVE
from cross_check.record import Array

ALPHA = 0.05
RESAMPLES = 1000
POWER_ENSEMBLES = 100  # the power is known to a standard error of 0.05 at worst
POWER_RESAMPLES = 200
SEED = 20100


@dataclass(frozen=True)
class CurveEquivalence:
    """What two ensembles of curves say; shapes (T,), unit of the observable, times in s.

    `difference` is left - right of the means, `largest` its largest absolute value and `time` where that is. `interval`
    has the lower and the upper limit of the largest difference, each at 95 %. `half_width` is that of the band around
    `difference`, which holds the true difference at all times at once with a probability of 95 %. `power` [-] is the
    probability of `agree` if the true difference were 0 at all times; None where it was not asked for.
    """

    verdict: str
    margin: float
    times: Array
    left_mean: Array
    right_mean: Array
    left_size: int
    right_size: int
    difference: Array
    largest: float
    time: float
    interval: tuple[float, float]
    half_width: float
    power: float | None

    def describe(self, unit: str = "") -> str:
        """The test in one sentence, for the note of a comparison."""
        mark = f" {unit}" if unit not in ("", "-") else ""
        low, high = self.interval
        power = "" if self.power is None else f"; power {self.power:.2f}"
        return (
            f"largest difference of the means {self.largest:.3g}{mark} at {self.time:.4g} s, limits {low:.3g} to "
            f"{high:.3g}{mark}, band +- {self.half_width:.3g}{mark}, margin {self.margin:.3g}; "
            f"n {self.left_size} and {self.right_size}{power}"
        )


def compare_curves(
    times: ArrayLike,
    left: ArrayLike,
    right: ArrayLike,
    margin: float,
    seed: int = SEED,
    power_ensembles: int = POWER_ENSEMBLES,
) -> CurveEquivalence:
    """Compares two ensembles of curves, shapes (n, T) and (m, T), over common times of shape (T,).

    The same arguments give the same result: `seed` starts the generator that draws the seeds anew. The power is left
    out where `power_ensembles` is 0. Raises Undefined for an ensemble of one, BadSample for what cannot be used.
    """
    if not (math.isfinite(margin) and margin > 0.0):
        raise BadSample(f"margin {margin}: expected a positive finite number")
    common = _times(times)
    first, second = _curves(left, len(common), "left"), _curves(right, len(common), "right")
    generator = np.random.default_rng(seed)
    low, high, half = _limits(first, second, generator, RESAMPLES)
    difference = first.mean(axis=0) - second.mean(axis=0)
    peak = int(np.argmax(np.abs(difference)))
    return CurveEquivalence(
        verdict=AGREE if high < margin else DIFFER if low > margin else INCONCLUSIVE,
        margin=margin,
        times=common,
        left_mean=first.mean(axis=0),
        right_mean=second.mean(axis=0),
        left_size=len(first),
        right_size=len(second),
        difference=difference,
        largest=float(np.abs(difference[peak])),
        time=float(common[peak]),
        interval=(low, high),
        half_width=half,
        power=_power(first, second, margin, generator, power_ensembles) if power_ensembles else None,
    )


def _limits(left: Array, right: Array, generator: np.random.Generator, resamples: int) -> tuple[float, float, float]:
    """Lower and upper limit of the largest difference, and the half width of the band."""
    difference = left.mean(axis=0) - right.mean(axis=0)
    error = _errors(left, generator, resamples) - _errors(right, generator, resamples)
    error *= _student_over_normal(left, right)
    half = _quantile(np.max(np.abs(error), axis=1))
    high = _quantile(np.max(np.abs(difference + error), axis=1))
    return max(float(np.max(np.abs(difference))) - half, 0.0), high, half


def _quantile(values: Array) -> float:
    # The next value above, not one between: a bootstrap of few seeds has few values.
    return float(np.quantile(values, 1.0 - ALPHA, method="higher"))


def _errors(curves: Array, generator: np.random.Generator, resamples: int) -> Array:
    """Means of curves drawn anew, less the mean of all, with the variance that the true error has; shape (R, T)."""
    size = len(curves)
    drawn = generator.integers(size, size=(resamples, size))
    weights = (drawn[:, :, None] == np.arange(size)).mean(axis=1)
    return math.sqrt(size / (size - 1)) * (weights @ (curves - curves.mean(axis=0)))


def _student_over_normal(left: Array, right: Array) -> Array:
    """Ratio of Student's to the normal quantile with Welch's degrees of freedom at each time, shape (T,)."""
    parts = [curves.var(axis=0, ddof=1) / len(curves) for curves in (left, right)]
    total = parts[0] + parts[1]
    share = np.divide(parts[0], total, out=np.full_like(total, 0.5), where=total > 0.0)
    freedom = 1.0 / (share**2 / (len(left) - 1) + (1.0 - share) ** 2 / (len(right) - 1))
    return np.asarray(stdtrit(freedom, 1.0 - ALPHA) / ndtri(1.0 - ALPHA), dtype=float)


def _power(left: Array, right: Array, margin: float, generator: np.random.Generator, ensembles: int) -> float:
    """Share of `agree` among ensembles of equal mean that are drawn from the deviations of these curves."""
    pools = [math.sqrt(len(curves) / (len(curves) - 1)) * (curves - curves.mean(axis=0)) for curves in (left, right)]
    found = 0
    for _ in range(ensembles):
        drawn = [pool[generator.integers(len(pool), size=len(pool))] for pool in pools]
        found += _limits(drawn[0], drawn[1], generator, POWER_RESAMPLES)[1] < margin
    return found / ensembles


def aligned(*ensembles: Sequence[tuple[Array, Array]]) -> tuple[Array, list[Array]]:
    """Curves of several ensembles at common times: the times (T,) and one array (n, T) per ensemble.

    A curve is (times (S,), values (S,)). The common times are those of the curve with the fewest samples in the span
    that all curves have; the others are interpolated linearly. Raises BadSample where no two times are common.
    """
    curves = [(_times(times), np.asarray(values, dtype=float)) for group in ensembles for times, values in group]
    if not curves:
        raise Undefined("there are no curves")
    for place, (times, values) in enumerate(curves):
        if values.shape != times.shape:
            raise BadSample(f"curve {place}: values of shape {values.shape} at times of shape {times.shape}")
    begin, end = max(times[0] for times, _ in curves), min(times[-1] for times, _ in curves)
    inside = [times[(times >= begin) & (times <= end)] for times, _ in curves]
    common = min(inside, key=len)
    if len(common) < 2:
        raise BadSample(f"the curves have fewer than two times in common between {begin} s and {end} s")
    rows = iter(curves)
    return common, [np.array([np.interp(common, *next(rows)) for _ in group]) for group in ensembles]


def _times(times: ArrayLike) -> Array:
    array = np.asarray(times, dtype=float)
    if array.ndim != 1 or len(array) == 0 or not np.all(np.isfinite(array)) or np.any(np.diff(array) <= 0.0):
        raise BadSample(f"times of shape {array.shape}: expected finite increasing times of shape (T,)")
    return array


def _curves(curves: ArrayLike, samples: int, name: str) -> Array:
    array = np.asarray(curves, dtype=float)
    if array.ndim != 2 or array.shape[1] != samples:
        raise BadSample(f"{name}: curves of shape {array.shape}, expected (n, {samples}), one row per seed")
    if not np.all(np.isfinite(array)):
        row, column = (int(index) for index in np.argwhere(~np.isfinite(array))[0])
        raise BadSample(f"{name}: curve {row} is {array[row, column]} at sample {column}, expected finite numbers")
    if len(array) < 2:
        raise Undefined(NO_SCATTER if len(array) else f"{name} is an ensemble without members")
    return array
