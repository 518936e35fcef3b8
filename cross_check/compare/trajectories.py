"""How long two runs of the same state stay together: the check `horizon`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cross_check.compare.horizons import COARSE, FINE, Divergence, divergence
from cross_check.compare.outcome import NATIVE, Outcomes, mirror_name
from cross_check.compare.quantity import Undefined
from cross_check.scene import Scene

QUANTITY = "trajectory"


def parting(scene: Scene, outcomes: Outcomes, left: str, right: str) -> Divergence:
    """How the trajectories of two sources part, in units of the smallest diameter. Raises Undefined."""
    one, other = (outcomes[source, 0].record for source in (left, right))
    missing = next(
        (outcomes[source, 0].verdict for source in (left, right) if outcomes[source, 0].record is None), None
    )
    if one is None or other is None:
        raise Undefined(missing or "no record")
    common = np.intersect1d(one.step, other.step)
    left_places, right_places = (record["position"][np.isin(record.step, common)] for record in (one, other))
    diameter = 2.0 * min(particle.radius for particle in scene.particles)
    return divergence(common * scene.time_step, left_places, right_places, diameter)


def describe(found: Divergence) -> str:
    """The horizons and the growth in words."""
    times = [
        f"passes {limit:g} d {'never' if time is None else f'at {time:.4g} s'}"
        for limit, time in ((FINE, found.fine), (COARSE, found.coarse))
    ]
    growth = found.growth
    rate = (
        found.growth_note if growth is None else f"grows as exp({growth.rate:.3g} t / s) +- {growth.standard_error:.2g}"
    )
    largest = float(np.max(found.largest)) / found.diameter
    return f"{', '.join(times)}; {rate}; at most {largest:.3g} d within {found.times[-1]:.4g} s"


def pairs(codes: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """The sources whose trajectories are compared: each code with its mirror, which is judged, and with native."""
    for code in codes:
        yield mirror_name(code), code
        yield NATIVE, code
