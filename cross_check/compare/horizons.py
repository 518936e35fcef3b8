"""Growth of the difference of two runs that began in the same state: horizons, growth rate, deterministic window.

The difference of a particle is the distance of its places in the two runs. Dense granular flow amplifies it
exponentially until it is as large as a particle: until it passes FINE = 1e-6 diameters two codes compute the same
trajectory (the deterministic window), beyond COARSE = 1e-2 diameters they share their statistics only.

The growth rate is the slope of the logarithm of the rms difference over time, by least squares over the samples between
FIT_FROM (far above the rounding of positions) and COARSE (below saturation) diameters.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cross_check.compare.samples import BadSample
from cross_check.record import Array

FINE = 1e-6
COARSE = 1e-2
FIT_FROM = 1e-11
FEWEST = 4  # samples that a growth rate is fitted to


@dataclass(frozen=True)
class Growth:
    """An exponential growth: `rate` [1/s] with its standard error [1/s], from `begin` to `end` [s].

    `scatter` [-] is the standard deviation of the logarithm from the line: exponential growth leaves little of it.
    """

    rate: float
    standard_error: float
    begin: float
    end: float
    samples: int
    scatter: float


@dataclass(frozen=True)
class Divergence:
    """How two trajectories part: `rms` and `largest` distance over the particles [m] at `times` [s], shapes (T,).

    `fine` and `coarse` are the times [s] at which `largest` passes FINE and COARSE diameters, `rms_fine` and
    `rms_coarse` those of `rms`; None where it does not. `growth` is None where `growth_note` says why.
    """

    times: Array
    rms: Array
    largest: Array
    diameter: float
    fine: float | None
    coarse: float | None
    rms_fine: float | None
    rms_coarse: float | None
    growth: Growth | None
    growth_note: str

    @property
    def deterministic_window(self) -> float:
        """Time [s] until which no particle is off by FINE diameters: the end of the run where none ever is."""
        return float(self.times[-1]) if self.fine is None else self.fine

    def in_window(self) -> NDArray[np.bool_]:
        """Which samples lie in the deterministic window, shape (T,) of bool."""
        return self.times <= self.deterministic_window if self.fine is None else self.times < self.fine


def divergence(times: ArrayLike, left: ArrayLike, right: ArrayLike, diameter: float) -> Divergence:
    """Compares positions of the same particles, shapes (T, N, 3) [m], at times (T,) [s]; `diameter` [m] is the scale.

    Positions must run on across periodic faces, as those of run records do. Raises BadSample for other shapes, for
    numbers that are not finite and for a diameter that is not positive.
    """
    if not (math.isfinite(diameter) and diameter > 0.0):
        raise BadSample(f"diameter {diameter} m: expected a positive finite number")
    time = np.asarray(times, dtype=float)
    if time.ndim != 1 or len(time) == 0 or not np.all(np.isfinite(time)) or np.any(np.diff(time) <= 0.0):
        raise BadSample(f"times of shape {time.shape}: expected finite increasing times of shape (T,)")
    first, second = _positions(left, len(time), "left"), _positions(right, len(time), "right")
    if first.shape != second.shape:
        raise BadSample(f"{first.shape[1]} particles on the left, {second.shape[1]} on the right: expected the same")
    distance = np.linalg.norm(first - second, axis=2)
    rms = diameter * np.sqrt(np.mean((distance / diameter) ** 2, axis=1))
    largest = np.max(distance, axis=1)
    growth, note = _growth(time, rms, diameter)
    return Divergence(
        time,
        rms,
        largest,
        diameter,
        passing(time, largest, FINE * diameter),
        passing(time, largest, COARSE * diameter),
        passing(time, rms, FINE * diameter),
        passing(time, rms, COARSE * diameter),
        growth,
        note,
    )


def passing(times: Array, values: Array, threshold: float) -> float | None:
    """The first time [s] at which non-negative values, shape (T,), pass a threshold; None where they never do.

    Between two samples the logarithm is taken as linear in time. A value of 0 has none: where the sample before is 0,
    the threshold counts as passed there, the last time at which it is known not to have been.
    """
    above = np.flatnonzero(values > threshold)
    if len(above) == 0:
        return None
    place = int(above[0])
    if place == 0 or values[place - 1] == 0.0:
        return float(times[max(place - 1, 0)])
    before, after = math.log(values[place - 1]), math.log(values[place])
    share = (math.log(threshold) - before) / (after - before)
    return float(times[place - 1] + share * (times[place] - times[place - 1]))


def _growth(times: Array, rms: Array, diameter: float) -> tuple[Growth | None, str]:
    """The growth between FIT_FROM and COARSE, or None and the reason."""
    above = np.flatnonzero(rms > COARSE * diameter)
    end = int(above[0]) if len(above) else len(rms)
    below = np.flatnonzero(rms[:end] < FIT_FROM * diameter)
    begin = int(below[-1]) + 1 if len(below) else 0
    if end - begin < FEWEST:
        span = f"{FIT_FROM:g} and {COARSE:g} diameters"
        return None, f"{end - begin} samples lie between {span}, a fit needs {FEWEST}"
    x, y = times[begin:end], np.log(rms[begin:end])
    centred = x - x.mean()
    spread = float(centred @ centred)
    rate = float(centred @ (y - y.mean())) / spread
    rest = y - y.mean() - rate * centred
    variance = float(rest @ rest) / (len(x) - 2)
    growth = Growth(rate, math.sqrt(variance / spread), float(x[0]), float(x[-1]), len(x), math.sqrt(variance))
    return growth, ""


def _positions(positions: ArrayLike, samples: int, name: str) -> Array:
    array = np.asarray(positions, dtype=float)
    if array.ndim != 3 or array.shape[0] != samples or array.shape[1] == 0 or array.shape[2] != 3:
        raise BadSample(f"{name}: positions of shape {array.shape}, expected ({samples}, N, 3)")
    if not np.all(np.isfinite(array)):
        sample, particle, _ = (int(index) for index in np.argwhere(~np.isfinite(array))[0])
        raise BadSample(f"{name}: the position of particle {particle} is not a finite number at sample {sample}")
    return array
