"""Closed forms against published numbers and against integration of the equation of motion."""

from __future__ import annotations

import functools
import math
from dataclasses import replace
from typing import Any, cast

import pytest
from scipy import integrate

from cross_check.reference import closed_forms
from cross_check.scene import Scene
from cross_check.suites import named

case_of = functools.cache(named)


def scene(case: str, variant: str) -> Scene:
    return next(item.scenes[0] for item in case_of(case).variants if item.name == variant)


# Peak forces and durations of Chung and Ooi's tests as printed by the suites that restate them.
PUBLISHED = [
    ("chung-ooi-1", "glass", 10696.9, 4.03395e-5),
    ("chung-ooi-1", "limestone", 7108.24, 5.42010e-5),
    ("chung-ooi-2", "al-alloy", 11369.9, 7.31657e-4),
    ("chung-ooi-2", "mg-alloy", 7232.68, 7.67066e-4),
    ("chung-ooi-3-cut", "al-oxide,e=1", 615.352, 6.10451e-6),
    ("chung-ooi-3-cut", "cast-iron,e=1", 506.760, 1.29721e-5),
]


@pytest.mark.parametrize(("case", "variant", "force", "duration"), PUBLISHED)
def test_elastic_impacts_have_their_published_numbers(case: str, variant: str, force: float, duration: float) -> None:
    forms = closed_forms()
    assert forms["hertz_impact.peak_force"](scene(case, variant)) == pytest.approx(force, rel=6e-6)
    assert forms["hertz_impact.contact_duration"](scene(case, variant)) == pytest.approx(duration, rel=6e-6)


def rebound(damping: float, cut: bool) -> float:
    """Rebound of a Hertz contact with K = m* = v = 1, from the equation of motion [-]."""

    def force(overlap: float, velocity: float) -> float:
        stiffness = 1.5 * math.sqrt(overlap)
        return overlap**1.5 + 2.0 * math.sqrt(5.0 / 6.0) * damping * math.sqrt(stiffness) * velocity

    def motion(_: float, state: list[float]) -> list[float]:
        return [state[1], -force(max(state[0], 0.0), state[1])]

    def separated(_: float, state: list[float]) -> float:
        return force(max(state[0], 0.0), state[1]) if cut and state[1] < 0.0 else state[0] + 1e-30

    separated.terminal, separated.direction = True, -1.0  # pyright: ignore[reportFunctionMemberAccess]
    done = cast(Any, integrate).solve_ivp(
        motion, (0.0, 200.0), [1e-9, 1.0], events=separated, rtol=1e-11, atol=1e-13, method="DOP853"
    )
    return float(-done.y[1][-1])


@pytest.mark.parametrize("restitution", [0.9, 0.5, 0.2])
@pytest.mark.parametrize("cut", [True, False])
def test_damped_impacts_follow_their_equation_of_motion(restitution: float, cut: bool) -> None:
    base = scene("chung-ooi-3-cut", "al-oxide,e=0.8")
    logarithm = math.log(restitution)
    damping = -logarithm / math.hypot(logarithm, math.pi)
    changed = replace(base, pairs=(replace(base.pairs[0], restitution=restitution, damping_ratio=damping),))
    form = closed_forms()["damped_impact.restitution_cut" if cut else "damped_impact.restitution_uncut"]
    assert form(changed) == pytest.approx(rebound(damping, cut), abs=2e-6)


def test_critical_damping_has_its_limits() -> None:
    base = scene("chung-ooi-3-cut", "al-oxide,e=0")
    assert closed_forms()["damped_impact.restitution_cut"](base) == pytest.approx(math.exp(-2.0), rel=1e-14)
    assert closed_forms()["damped_impact.restitution_uncut"](base) == 0.0
