"""The compression test: stiffness, failure and dilatancy from stress and density over the strain."""

from __future__ import annotations

import numpy as np

from cross_check.record import Array
from cross_check.sintering.outcome import Numbers

# The stiffness is fitted where the stress has risen by so much of the way from the pressure to the failure stress.
FITTED = (0.1, 0.5)


def strength_numbers(strain: Array, stress: Array, density: Array, pressure: float) -> Numbers:
    """Numbers of a test from its samples, shapes (T,): strain [-], stress on the top wall [N/m], density [-]."""
    failed = int(np.argmax(stress))
    densest = int(np.argmax(density))
    return {
        "failure_stress": float(stress[failed]),
        "failure_strain": float(strain[failed]),
        "stiffness": stiffness(strain, stress, pressure),
        "nu_start": float(density[0]),
        "nu_gain": float(density[densest] - density[0]),
        "nu_drop": float(density[densest] - np.min(density[densest:])),
        "strain_end": float(strain[-1]),
    }


def stiffness(strain: Array, stress: Array, pressure: float) -> float:
    """Slope of the stress over the strain [N/m], NaN where fewer than three samples lie in the fitted range.

    The range is that of the first rise, from 10 to 50 % of the way between the pressure and the largest stress.
    """
    failed = int(np.argmax(stress))
    low, high = (pressure + share * (stress[failed] - pressure) for share in FITTED)
    above = np.flatnonzero(stress[: failed + 1] > high)
    end = int(above[0]) if len(above) else failed
    below = np.flatnonzero(stress[:end] < low)
    first = int(below[-1]) + 1 if len(below) else 0
    rows = slice(first, end)
    if end - first < 3 or np.ptp(strain[rows]) == 0.0:
        return np.nan
    return float(np.polyfit(strain[rows], stress[rows], 1)[0])
