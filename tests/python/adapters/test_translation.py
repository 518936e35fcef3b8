"""Numbers of the translations, what is not comparable, and what may not enter a deck."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from cross_check.adapters import ADAPTERS, capability
from cross_check.adapters.interface import Deck, InvalidScene, NotComparable
from cross_check.adapters.lammps.laws import TSUJI, tsuji_number
from cross_check.adapters.liggghts.laws import restitution_of
from cross_check.adapters.render import number, word
from cross_check.adapters.yade.laws import betan_of
from cross_check.scene import Body, Cylinder, Motion, Scene, Vector

from . import scenes


def value(deck: Deck, case_key: str) -> str:
    return next(row.code_value for row in deck.translation if row.case_key == case_key)


def test_dashpots_of_restitution_0_8_are_the_proved_numbers() -> None:
    b = scenes.damping_ratio(0.8)
    assert betan_of(b) == pytest.approx(0.0646771793717, rel=1e-12)
    assert tsuji_number(b) == pytest.approx(0.729230743185, rel=1e-11)
    assert restitution_of(b) == pytest.approx(0.8, rel=1e-15)


@pytest.mark.parametrize("b", [1e-6, 1e-4, 0.01, 0.07, 0.5, 0.6, 1.0, 3.0])
def test_tsuji_number_gives_back_the_dashpot(b: float) -> None:
    x = tsuji_number(b)
    assert sum(factor * x**power for power, factor in enumerate(TSUJI)) == pytest.approx(math.sqrt(5) * b, abs=1e-14)


def test_weak_restitution_needs_a_negative_tsuji_number() -> None:
    assert tsuji_number(scenes.damping_ratio(0.1)) == pytest.approx(-0.0111, abs=1e-4)
    assert tsuji_number(scenes.damping_ratio(0.1137)) > 0


def test_stated_restitution_is_typed_as_stated() -> None:
    assert value(ADAPTERS["liggghts"].deck(scenes.pair()), "pairs.glass+glass.restitution") == number(0.8)


def test_restitution_of_another_dashpot_is_not_typed() -> None:
    whole = scenes.pair()
    stated = tuple(replace(pair, damping_ratio=0.05) for pair in whole.pairs)
    deck = ADAPTERS["liggghts"].deck(replace(whole, pairs=stated))
    assert value(deck, "pairs.glass+glass.damping_ratio") == number(restitution_of(0.05))


def test_lammps_gets_the_stiffness_of_the_pair() -> None:
    deck = ADAPTERS["lammps"].deck(scenes.pair())
    assert float(value(deck, "pairs.glass+glass.effective_young")) == pytest.approx(4 / 3 * 1e7 / (2 * 0.91), rel=1e-15)


def test_no_dashpot_is_no_dashpot() -> None:
    elastic = scenes.pair(restitution=1.0)
    assert value(ADAPTERS["liggghts"].deck(elastic), "pairs.glass+glass.restitution") == "1"
    assert value(ADAPTERS["yade"].deck(elastic), "pairs.glass+glass.damping_ratio") == "0"
    assert "damping velocity" in ADAPTERS["lammps"].deck(elastic).files["scene.lmp"]


def test_yade_starts_half_a_step_before() -> None:
    deck = ADAPTERS["yade"].deck(scenes.floor())
    assert number(-0.5 + 0.5 * 5e-7 * 9.81) in deck.files["scene.py"]


@pytest.mark.parametrize(("code", "default"), [("liggghts", "off"), ("yade", "on"), ("lammps", "off")])
def test_mirror_resolves_the_cut(code: str, default: str) -> None:
    mirror = ADAPTERS[code].mirror(scenes.pair())
    assert mirror.model.normal.force_cut == default
    assert ADAPTERS[code].mirror(scenes.pair("on")).model.normal.force_cut == "on"
    staggered = code == "yade"
    assert mirror.mirror.start == ("staggered" if staggered else "synchronized")
    assert mirror.mirror.plane_radius_factor == (1e8 if staggered else None)


def other_law() -> Scene:
    whole = scenes.pair()
    return replace(whole, model=replace(whole.model, normal=replace(whole.model.normal, law="jkr")))


def disk() -> Scene:
    whole = scenes.pair()
    return replace(whole, particles=(replace(whole.particles[0], moment_of_inertia=1e-3), whole.particles[1]))


def tilted() -> Scene:
    body = scenes.plane("ramp", 1, scenes.ZERO, (0.6, 0.0, 0.8))
    return replace(scenes.floor(), bodies=(body,))


def pushed(*velocity: float) -> Scene:
    body = scenes.plane("floor", 1, scenes.ZERO, (0.0, 0.0, 1.0), (velocity[0], velocity[1], velocity[2]))
    return replace(scenes.floor(), bodies=(body,))


def other_modulus() -> Scene:
    whole = scenes.pair()
    return replace(whole, pairs=tuple(replace(pair, effective_young=5e6) for pair in whole.pairs))


def periodic() -> Scene:
    whole = scenes.floor()
    return replace(whole, domain=replace(whole.domain, boundary=("periodic", "open", "open")))


def tube(velocity: Vector = scenes.ZERO, axis: Vector = (0.0, 0.0, 1.0)) -> Scene:
    motion = Motion("prescribed", velocity) if any(velocity) else Motion("fixed")
    body = Body("tube", 1, Cylinder(scenes.ZERO, axis, 0.02), motion)
    return replace(scenes.floor(), bodies=(body,))


def across(axis: int, body: Body) -> Scene:
    whole = scenes.floor()
    x, y, z = ("periodic" if axis == other else "open" for other in range(3))
    return replace(whole, domain=replace(whole.domain, boundary=(x, y, z)), bodies=(body,))


def overdamped() -> Scene:
    whole = scenes.pair()
    return replace(whole, pairs=tuple(replace(pair, damping_ratio=1.0, restitution=None) for pair in whole.pairs))


@pytest.mark.parametrize(
    ("code", "whole", "reason"),
    [
        ("yade", scenes.pair("off"), "YADE always cuts"),
        ("yade", periodic(), "a Wall body in a periodic cell"),
        ("yade", tube(), "body tube: YADE has no inside of a cylinder"),
        ("liggghts", tube((0.1, 0.0, 0.0)), "body tube: LIGGGHTS slides a cylinder along itself only"),
        *((code, tube(axis=(0.6, 0.0, 0.8)), "body tube: only cylinders along x, y or z") for code in ADAPTERS),
        ("yade", other_modulus(), r"YADE forms E\*"),
        ("liggghts", other_modulus(), r"LIGGGHTS forms E\*"),
        ("liggghts", overdamped(), "LIGGGHTS accepts 0.05 < e <= 1.0"),
        ("liggghts", pushed(0.1, 0.0, 0.1), "body floor: LIGGGHTS slides a wall along one axis, or pushes it"),
        ("liggghts", pushed(0.1, 0.1, 0.0), "body floor: LIGGGHTS slides a wall along one axis, or pushes it"),
        *((code, other_law(), "the normal law jkr has no translation") for code in ADAPTERS),
        *((code, disk(), "moment of inertia") for code in ADAPTERS),
        *((code, tilted(), "body ramp: only planes whose normal lies along x, y or z") for code in ADAPTERS),
    ],
)
def test_what_a_code_has_no_form_for_is_not_comparable(code: str, whole: Scene, reason: str) -> None:
    with pytest.raises(NotComparable, match=reason):
        ADAPTERS[code].deck(whole)


@pytest.mark.parametrize(
    ("code", "whole"),
    [
        ("yade", scenes.pair("off", restitution=1.0)),
        ("yade", pushed(0.1, 0.1, 0.1)),
        ("lammps", pushed(0.1, 0.1, 0.1)),
        ("lammps", tube((0.1, 0.1, 0.1))),
        ("liggghts", tube((0.0, 0.0, 0.1))),
        *((code, across(0, scenes.floor().bodies[0])) for code in ("liggghts", "lammps")),
        ("liggghts", pushed(0.0, 0.0, 0.1)),
        ("lammps", other_modulus()),
        ("lammps", overdamped()),
    ],
)
def test_what_a_code_has_a_form_for_is_translated(code: str, whole: Scene) -> None:
    assert ADAPTERS[code].deck(whole).files


@pytest.mark.parametrize("code", list(ADAPTERS))
@pytest.mark.parametrize(
    ("whole", "reason"),
    [
        (replace(scenes.pair(), variant="x\nshell rm -r"), "cannot be written into a deck"),
        (replace(scenes.pair(), variant='a"b'), "cannot be written into a deck"),
        (replace(scenes.pair(), materials=(replace(scenes.GLASS, name="a b"), scenes.RIGID)), "cannot be written"),
        (replace(scenes.pair(), output_every=7), "steps 2000 is not a positive multiple of output_every 7"),
        (replace(scenes.pair(), time_step=0.0), "time_step 0.0 is not positive"),
        (replace(scenes.pair(), time_step=math.inf), "every number must be finite"),
        (replace(scenes.pair(), pairs=()), "no values for glass with glass"),
        (replace(scenes.pair(), particles=()), "no particles"),
        (scenes.pair("maybe"), "force_cut 'maybe' is unknown"),
        (across(2, scenes.floor().bodies[0]), "body floor is normal to z, along which the domain is periodic"),
        (across(0, tube().bodies[0]), "body tube is a cylinder across x, along which the domain is periodic"),
    ],
)
def test_a_scene_that_no_code_can_run_is_refused(code: str, whole: Scene, reason: str) -> None:
    with pytest.raises(InvalidScene, match=reason):
        ADAPTERS[code].deck(whole)


def test_only_safe_words_and_finite_numbers_enter_a_deck() -> None:
    assert word("chung-ooi-3/al=0.8") == "chung-ooi-3/al=0.8"
    for text in ("", "a b", "a\n", "$x", "a#b", "é"):
        with pytest.raises(InvalidScene):
            word(text)
    with pytest.raises(InvalidScene):
        number(math.nan)


def test_gravity_along_an_axis_is_exact() -> None:
    assert capability.gravity(scenes.floor()) == (9.81, (0.0, 0.0, -1.0))
    assert capability.gravity(scenes.pair()) == (0.0, (0.0, 0.0, -1.0))


def test_hash_follows_every_byte_and_name() -> None:
    deck = ADAPTERS["liggghts"].deck(scenes.pair())
    assert deck.hash == ADAPTERS["liggghts"].deck(scenes.pair()).hash
    ((name, text),) = deck.files.items()
    assert deck.hash != replace(deck, files={name: text + " "}).hash
    assert deck.hash != replace(deck, files={"other": text}).hash
