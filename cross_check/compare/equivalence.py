"""Equivalence of two ensembles within a margin: two one-sided tests, and their power.

Both hypotheses "true difference <= -margin" and "true difference >= margin" are tested at ALPHA = 0.05 with Welch's
statistic; where both fall, the ensembles agree. That is the case exactly where the interval at the level
1 - 2 ALPHA = 90 % lies inside of the margin, and so the same interval decides the other way: the ensembles differ where
it lies outside of the margin as a whole, which is one one-sided test at ALPHA. In between the data decide nothing.

Validity: means that are normal nearly, unpaired seeds. `agree` is wrong with a probability of at most ALPHA; `differ`
likewise where the margin is large against the standard error, and at most 2 ALPHA for a margin of next to nothing.
Source: D. J. Schuirmann, J. Pharmacokin. Biopharm. 15 (1987) 657-680 (two one-sided tests); B. L. Welch (1947),
see `cross_check.compare.samples`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import chdtri, ndtr, ndtri, stdtrit

from cross_check.compare.samples import BadSample, Sample, sample, welch
from cross_check.compare.verdicts import AGREE, DIFFER, INCONCLUSIVE
from cross_check.record import Array

ALPHA = 0.05
LEVEL = 1.0 - 2.0 * ALPHA
WANTED_POWER = 0.9
NODES = 48  # per sample variance: the power moves by less than 1e-3 with more of them
LARGE = 1000  # seeds per side from which the normal approximation of the needed size is off by about one
MOST = 1e15  # a needed size that is not told apart from larger ones


@dataclass(frozen=True)
class Equivalence:
    """What two one-sided tests of two ensembles say; values, `margin` and `interval` in the unit of the observable.

    `difference` is left - right, `interval` its interval at LEVEL, `p_lower` and `p_upper` [-] the one-sided p values
    at -margin and +margin. `power` [-] is the probability of `agree` at a true difference of 0 for the standard
    deviations and sizes of these samples; `needed` is the number of seeds per side that gives WANTED_POWER.
    """

    verdict: str
    margin: float
    left: Sample
    right: Sample
    difference: float
    interval: tuple[float, float]
    degrees_of_freedom: float
    p_lower: float
    p_upper: float
    power: float
    needed: int
    note: str = ""

    def describe(self, unit: str = "") -> str:
        """The test in one sentence, for the note of a comparison."""
        mark = f" {unit}" if unit not in ("", "-") else ""
        sides = " and ".join(
            f"{side.mean:.6g} (standard deviation {side.standard_deviation:.2g}, n {side.size})"
            for side in (self.left, self.right)
        )
        low, high = self.interval
        return (
            f"means {sides}{mark}; {LEVEL:.0%} interval of the difference {low:.3g} to {high:.3g}{mark}, "
            f"margin {self.margin:.3g}; p {max(self.p_lower, self.p_upper):.2g}; power {self.power:.2f}, "
            f"{self.needed} seeds per side for {WANTED_POWER}" + (f"; {self.note}" if self.note else "")
        )


def equivalence(left: ArrayLike, right: ArrayLike, margin: float) -> Equivalence:
    """Tests whether two ensembles of values per seed, shapes (n,) and (m,), have means within `margin` of each other.

    Raises Undefined for an ensemble of one, BadSample for values or a margin that cannot be used.
    """
    if not (math.isfinite(margin) and margin > 0.0):
        raise BadSample(f"margin {margin}: expected a positive finite number")
    first, second = sample(left, "left"), sample(right, "right")
    found = welch(first, second)
    p_lower, p_upper = found.p_above(-margin), found.p_below(margin)
    low, high = found.interval(LEVEL)
    if max(p_lower, p_upper) < ALPHA:
        verdict = AGREE
    elif low > margin or high < -margin:
        verdict = DIFFER
    else:
        verdict = INCONCLUSIVE
    return Equivalence(
        verdict=verdict,
        margin=margin,
        left=first,
        right=second,
        difference=found.difference,
        interval=(low, high),
        degrees_of_freedom=found.degrees_of_freedom,
        p_lower=p_lower,
        p_upper=p_upper,
        power=power(first.standard_deviation, second.standard_deviation, first.size, second.size, margin),
        needed=needed(first.standard_deviation, second.standard_deviation, margin),
        note="no value of either side depends on the seed: they are compared as they stand"
        if found.standard_error == 0.0
        else "",
    )


def power(left_deviation: float, right_deviation: float, left_size: int, right_size: int, margin: float) -> float:
    """Probability of `agree` at a true difference of 0, for normal samples of these standard deviations and sizes.

    With D the difference of the means, S its sampled standard error and nu the sampled degrees of freedom, it is
    P(|D| < margin - t(1 - ALPHA, nu) S). D is normal and independent of both sample variances, which are multiples of
    chi squared: what remains is an integral over their two quantiles, taken by Gauss and Legendre's rule.
    """
    error = math.hypot(left_deviation / math.sqrt(left_size), right_deviation / math.sqrt(right_size))
    if error == 0.0:
        return 1.0
    share = (left_deviation / math.sqrt(left_size) / error) ** 2
    first, first_weight = _variance_ratios(left_size)
    second, second_weight = _variance_ratios(right_size)
    left, right = share * first[:, None], (1.0 - share) * second[None, :]
    freedom = (left + right) ** 2 / (left**2 / (left_size - 1) + right**2 / (right_size - 1))
    room = margin / error - stdtrit(freedom, 1.0 - ALPHA) * np.sqrt(left + right)
    inside = np.where(room > 0.0, 2.0 * ndtr(room) - 1.0, 0.0)
    return float(min(first_weight @ inside @ second_weight, 1.0))


@cache
def _variance_ratios(size: int) -> tuple[Array, Array]:
    """Sampled over true variance at the nodes of an integral over its probability, and the weights; shapes (NODES,)."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    return np.asarray(chdtri(size - 1, 0.5 - 0.5 * nodes), dtype=float) / (size - 1), 0.5 * weights


def needed(left_deviation: float, right_deviation: float, margin: float) -> int:
    """The smallest number of seeds per side whose `power` is at least WANTED_POWER."""

    def enough(size: int) -> bool:
        return power(left_deviation, right_deviation, size, size, margin) >= WANTED_POWER

    if left_deviation == right_deviation == 0.0:
        return 2
    quantiles = float(ndtri(1.0 - ALPHA) + ndtri(0.5 + 0.5 * WANTED_POWER))
    ratio = quantiles * math.hypot(left_deviation, right_deviation) / margin
    guess = ratio * ratio
    if guess > LARGE:
        return math.ceil(min(guess, MOST))
    low, high = 1, max(2, math.ceil(guess))
    while not enough(high):
        low, high = high, high + max(1, high // 4)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high
