"""Samples of one value per seed, and the difference of two means with unequal scatter (Welch).

Equations, for samples of sizes n, means m and standard deviations s (divided by n - 1):

    d  = m1 - m2
    se = sqrt(s1^2/n1 + s2^2/n2)
    nu = se^4 / [(s1^2/n1)^2/(n1 - 1) + (s2^2/n2)^2/(n2 - 1)]

(d - true difference)/se follows Student's t with nu degrees of freedom nearly, for normal samples of any two variances.
Source: B. L. Welch, Biometrika 34 (1947) 28-35; F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110-114.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import stdtr, stdtrit

from cross_check.compare.quantity import Undefined

NO_SCATTER = "an ensemble of one has no scatter"


class BadSample(Exception):
    """Values that no statistic can be made of: the message names the sample, the value and what is allowed."""


@dataclass(frozen=True)
class Sample:
    """Mean and standard deviation (divided by n - 1) in the unit of the values, and their number `size`."""

    mean: float
    standard_deviation: float
    size: int

    @property
    def standard_error(self) -> float:
        """Standard deviation of the mean, in the unit of the values."""
        return self.standard_deviation / math.sqrt(self.size)


def sample(values: ArrayLike, name: str) -> Sample:
    """The sample of values of shape (n,), one per seed; `name` stands in errors.

    Raises Undefined for an ensemble of one or none, BadSample for another shape and for what is not a finite number.
    """
    array = np.asarray(values, dtype=float)
    if array.ndim != 1:
        raise BadSample(f"{name}: values of shape {array.shape}, expected (n,), one per seed")
    if not np.all(np.isfinite(array)):
        place = int(np.flatnonzero(~np.isfinite(array))[0])
        raise BadSample(f"{name}: value {place} is {array[place]}, expected finite numbers")
    if len(array) < 2:
        raise Undefined(NO_SCATTER if len(array) else f"{name} is an ensemble without members")
    if np.ptp(array) == 0.0:  # a mean of equal values may differ from them by rounding, which is no scatter
        return Sample(float(array[0]), 0.0, len(array))
    return Sample(float(np.mean(array)), float(np.std(array, ddof=1)), len(array))


@dataclass(frozen=True)
class Welch:
    """The difference of two means, its standard error (both in the unit of the values) and degrees of freedom [-].

    Where neither sample scatters, the standard error is 0 and the statements are the limits of small scatter.
    """

    difference: float
    standard_error: float
    degrees_of_freedom: float

    def interval(self, level: float) -> tuple[float, float]:
        """The two-sided confidence interval of the true difference at a level such as 0.9."""
        half = float(stdtrit(self.degrees_of_freedom, 0.5 + 0.5 * level)) * self.standard_error
        return self.difference - half, self.difference + half

    def p_above(self, bound: float) -> float:
        """One-sided p value of: the true difference is at most `bound`. Small if it is above."""
        return self._tail(self.difference - bound)

    def p_below(self, bound: float) -> float:
        """One-sided p value of: the true difference is at least `bound`. Small if it is below."""
        return self._tail(bound - self.difference)

    def p_changed(self) -> float:
        """Two-sided p value of: the true difference is 0."""
        return min(1.0, 2.0 * min(self.p_above(0.0), self.p_below(0.0)))

    def _tail(self, distance: float) -> float:
        if self.standard_error == 0.0:
            return 0.5 if distance == 0.0 else float(distance < 0.0)
        return float(stdtr(self.degrees_of_freedom, -distance / self.standard_error))


def welch(left: Sample, right: Sample) -> Welch:
    """The difference of the means of two samples, left - right."""
    difference = left.mean - right.mean
    error = math.hypot(left.standard_error, right.standard_error)
    if error == 0.0:
        return Welch(difference, 0.0, float(left.size + right.size - 2))
    # Shares of the variance, not the variances: their fourth powers would underflow for small units.
    shares = (left.standard_error / error, right.standard_error / error)
    inverse = shares[0] ** 4 / (left.size - 1) + shares[1] ** 4 / (right.size - 1)
    return Welch(difference, error, 1.0 / inverse)
