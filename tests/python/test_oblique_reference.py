"""The integrated oblique impact against closed forms, and native against it at a coarse step."""

from __future__ import annotations

import functools
import math
from dataclasses import replace

import pytest

from cross_check.reference import closed_forms
from cross_check.scene import Scene
from cross_check.suites import named

case_of = functools.cache(named)
FORMS = closed_forms()


def scene(case: str, variant: str) -> Scene:
    return next(item.scenes[0] for item in case_of(case).variants if item.name == variant)


def with_friction(whole: Scene, friction: float) -> Scene:
    return replace(whole, pairs=tuple(replace(pair, friction=friction) for pair in whole.pairs))


@pytest.mark.parametrize("variant", ["steel,vt=12", "polyethylene,vt=21"])
def test_an_elastic_sliding_impact_loses_mu_times_the_change_of_normal_velocity(variant: str) -> None:
    whole = scene("chung-ooi-5-sliding", variant)
    x, _, z = whole.particles[0].velocity
    change = 2.0 * 0.3 * abs(z)
    assert FORMS["oblique_impact.tangential_velocity"](whole) == pytest.approx(x - change, rel=1e-11)
    assert FORMS["oblique_impact.tangential_restitution"](whole) == pytest.approx(1.0 - change / x, rel=1e-11)


@pytest.mark.parametrize("variant", ["al-alloy,omega=8", "nylon,omega=21"])
def test_a_damped_sliding_impact_loses_mu_times_the_change_of_normal_velocity(variant: str) -> None:
    whole = scene("chung-ooi-6", variant)
    restitution = FORMS["damped_impact.restitution_cut"](whole)
    change = 0.4 * (1.0 + restitution) * 0.2
    assert abs(FORMS["oblique_impact.tangential_velocity"](whole)) == pytest.approx(change, rel=1e-10)


def test_an_impact_without_friction_changes_neither_slip_nor_spin() -> None:
    whole = with_friction(scene("chung-ooi-4", "al-oxide,angle=30"), 0.0)
    assert FORMS["oblique_impact.tangential_restitution"](whole) == pytest.approx(1.0, abs=1e-14)
    assert FORMS["oblique_impact.rebound_spin"](whole) == 0.0


def test_the_rebound_of_test_4_has_its_published_extremes() -> None:
    """Kharaz, Gorham, Salman (2001): spin up to 617 rad/s near 30 degrees, restitution down to 0.616 at 20."""
    angles = (10, 15, 20, 25, 30, 35)
    spins = {a: FORMS["oblique_impact.rebound_spin"](scene("chung-ooi-4", f"al-oxide,angle={a}")) for a in angles}
    ratios = {
        a: FORMS["oblique_impact.tangential_restitution"](scene("chung-ooi-4", f"al-oxide,angle={a}")) for a in angles
    }
    assert max(spins, key=lambda a: spins[a]) in (25, 30)
    assert max(spins.values()) == pytest.approx(617.0, rel=0.03)
    assert min(ratios, key=lambda a: ratios[a]) == 20
    assert min(ratios.values()) == pytest.approx(0.616, abs=0.02)


def test_a_wall_is_the_limit_of_a_large_sphere() -> None:
    """1,000 times as large and heavy, the partner changes the rebound by about a part in a thousand."""
    wall, pair = scene("chung-ooi-6", "al-alloy,omega=1"), scene("chung-ooi-8", "al-alloy-stiff,omega=1")
    large = replace(pair.particles[1], radius=100.0, position=(0.0, 0.0, -100.0))
    near = replace(pair, particles=(pair.particles[0], large))
    one, other = (FORMS["oblique_impact.rebound_spin"](whole) for whole in (wall, near))
    assert one == pytest.approx(other, rel=5e-3)
    assert not math.isclose(one, other, rel_tol=1e-9)


def test_what_the_equations_do_not_hold_for_is_refused() -> None:
    heavy = replace(scene("chung-ooi-6", "al-alloy,omega=1"), gravity=(0.0, 0.0, -9.81))
    with pytest.raises(ValueError, match="without gravity"):
        FORMS["oblique_impact.rebound_spin"](heavy)
    oblique = scene("oblique-pair", "mindlin")
    with pytest.raises(ValueError, match="head-on"):
        FORMS["oblique_impact.rebound_spin"](oblique)
