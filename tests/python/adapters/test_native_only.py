"""What only the native engine computes: every code and every mirror of one says so, by name."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import NotComparable
from cross_check.bodies import Load, OscillatingMotion, ServoMotion
from cross_check.contact_model import LudingSintering, Model, SinteringFriction
from cross_check.materials import Expansion
from cross_check.scene import Scene, SetMotion, Stage, Start
from cross_check.stages import Action, RampTemperature, Remove, SetRelaxationTime, Strain

from . import scenes

UP = (0.0, 0.0, 1.0)
SERVO = ServoMotion(kind="servo", direction=UP, load=Load("force", 1.0), mass=1e-3, damping=0.0)
SHAKEN = OscillatingMotion(kind="oscillating", direction=UP, amplitude=1e-4, frequency=100.0)
LAW = LudingSintering(
    law="luding_sintering",
    k1=1e5,
    k2=2e5,
    kc=1e5,
    fluid_overlap=2e-4,
    dashpot=0.2,
    melting_temperature=393.15,
    melting_range=10.0,
    relaxation_time=1000.0,
    cooling="lagged",
)
FRICTION = SinteringFriction("luding_sintering", 0.2, 0.05, "softens", "cut")


def floor() -> Scene:
    """A sphere on a floor, which every code runs."""
    return scenes.floor()


def staged(*actions: Action, every: int | None = None) -> Scene:
    whole = floor()
    half = whole.steps // 2
    return replace(whole, stages=(Stage("first", half), Stage("second", whole.steps - half, actions, every)))


def disks() -> Scene:
    whole = floor()
    turned = [replace(one, moment_of_inertia=0.5 * one.mass * one.radius**2) for one in whole.particles]
    return replace(whole, disk_height=6e-3, particles=tuple(turned))


def expanding() -> Scene:
    whole = floor()
    materials = [replace(material, expansion=Expansion(1e-4, 393.15)) for material in whole.materials]
    return replace(whole, materials=tuple(materials))


SCENES = {
    "normal law": (replace(floor(), model=Model(LAW)), "the normal law luding_sintering has no translation in"),
    "tangential law": (
        replace(floor(), model=replace(floor().model, tangential=FRICTION)),
        "the tangential law luding_sintering has no translation in",
    ),
    "disks": (disks(), "particles are disks, the codes have spheres"),
    "temperature": (replace(floor(), temperature=353.15), "the particles have a temperature"),
    "expansion": (expanding(), "the particles have a temperature"),
    "start": (replace(floor(), start=Start(scenes.pair(), 10)), "starts from a state of the case adapters"),
    "servo": (
        replace(floor(), bodies=(replace(floor().bodies[0], motion=SERVO),)),
        "the motion servo of floor has no translation",
    ),
    "shaken": (staged(SetMotion(0, SHAKEN)), "the motion oscillating of floor has no translation"),
    "strain": (staged(Strain(0, 0, 0.1)), "the motion strain of floor has no translation"),
    "remove": (staged(Remove(0)), "the action remove has no translation"),
    "ramp": (staged(RampTemperature(400.0)), "the action ramp_temperature has no translation"),
    "relaxation": (staged(SetRelaxationTime(0.1)), "the action set_relaxation_time has no translation"),
    # Seven does not divide the steps: what has no translation need not be valid for one.
    "sampling": (staged(every=7), "samples of a stage at intervals of its own have no translation"),
}


@pytest.mark.parametrize("code", ADAPTERS)
@pytest.mark.parametrize("name", SCENES)
def test_decks_and_mirrors_name_what_the_codes_lack(code: str, name: str) -> None:
    scene, reason = SCENES[name]
    for translated in (ADAPTERS[code].deck, ADAPTERS[code].mirror):
        with pytest.raises(NotComparable) as refused:
            translated(scene)
        assert reason in str(refused.value)


@pytest.mark.parametrize("code", ADAPTERS)
def test_all_that_is_lacking_is_named_at_once(code: str) -> None:
    scene = replace(disks(), temperature=353.15, start=Start(scenes.pair(), 10), model=Model(LAW))
    with pytest.raises(NotComparable) as refused:
        ADAPTERS[code].deck(scene)
    assert str(refused.value).count("; ") == 3


@pytest.mark.parametrize("code", ADAPTERS)
def test_a_stage_that_states_the_interval_of_the_scene_is_translated(code: str) -> None:
    whole = staged()
    stated = staged(every=whole.output_every)
    assert ADAPTERS[code].deck(stated).files == ADAPTERS[code].deck(whole).files
