"""Decks of friction, moments, adhesion and hysteresis: byte for byte, and what is not comparable."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path

import pytest

import crossgrain
from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import InvalidScene, NotComparable
from cross_check.contact_model import Model, MomentModel, NormalModel, TwistingModel
from cross_check.scene import Scene, from_json

from . import contact_scenes, scenes
from .contact_scenes import rolling

SNAPSHOTS = Path(__file__).parent / "snapshots"
FRICTION = contact_scenes.frictional_scenes()


def wanted(code: str) -> dict[str, Scene]:
    """The scenes whose decks are stored."""
    found = {name: FRICTION[name] for name in ("mindlin/floor", "mindlin/pair/slip", "linear/floor")}
    for name, law in contact_scenes.moment_laws()[code].items():
        found[name] = contact_scenes.with_moments(contact_scenes.spinning_floor(), law, name)
    found |= contact_scenes.adhesive_scenes(code)
    if code != "lammps":
        found["luding"] = contact_scenes.luding_scenes()["floor"]
    return found


NAMES = [(code, name) for code in ADAPTERS for name in wanted(code)]


@pytest.mark.parametrize(("code", "name"), NAMES)
def test_deck_is_the_reviewed_one(code: str, name: str) -> None:
    for file, text in ADAPTERS[code].deck(wanted(code)[name]).files.items():
        path = SNAPSHOTS / code / name.replace("/", "-") / f"{file}.txt"
        if os.environ.get("CROSSGRAIN_UPDATE_SNAPSHOTS"):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        assert text == path.read_text(), f"{path} differs from the deck of today"


@pytest.mark.parametrize(("code", "name"), NAMES)
def test_scenes_and_mirrors_survive_json(code: str, name: str) -> None:
    whole = wanted(code)[name]
    for scene in (whole, ADAPTERS[code].mirror(whole)):
        assert from_json(json.loads(scene.to_json())) == scene


@pytest.mark.parametrize(("code", "name"), NAMES)
def test_the_engine_reads_scenes_and_mirrors(code: str, name: str, tmp_path: Path) -> None:
    """An engine that lacks the law says so by name; it knows every key."""
    whole = replace(wanted(code)[name], steps=1)
    for place, scene in enumerate((whole, ADAPTERS[code].mirror(whole))):
        try:
            crossgrain.run_scene(scene.to_json(), tmp_path / str(place))
        except ValueError as error:
            assert "this version has no law" in str(error), str(error)


def moved(law: MomentModel, friction: float = 0.3) -> Scene:
    return contact_scenes.with_moments(scenes.oblique_pair(), law, "other", friction)


def dmt(cut: str, friction: bool) -> Scene:
    tangential = contact_scenes.MINDLIN if friction else contact_scenes.FRICTIONLESS
    model = Model(NormalModel("dmt", cut), tangential)
    return contact_scenes.with_laws(scenes.pair(), model, "dmt", friction=0.3, work_of_adhesion=0.05)


HISTORY = contact_scenes.mindlin(scenes.pair(), 0.3, "rescaled", "force_rescaled")
TANGENTIAL, CONSTANT = rolling(("tangential", None)), rolling(("constant", 1e-3))


@pytest.mark.parametrize(
    ("code", "whole", "reason"),
    [
        ("liggghts", HISTORY, "history force_rescaled has no translation in LIGGGHTS"),
        ("yade", HISTORY, "history force_rescaled has no translation in YADE"),
        ("liggghts", moved(CONSTANT), "rolling stiffness constant has no translation in LIGGGHTS"),
        ("liggghts", moved(rolling(("tangential", None), limit="unlimited")), "LIGGGHTS caps rolling torques"),
        ("liggghts", moved(rolling(("tangential", None), twisting=TwistingModel("spot"))), "not as spot"),
        ("yade", moved(TANGENTIAL), "does not follow the overlap"),
        ("lammps", moved(TANGENTIAL), "does not follow the overlap"),
        ("yade", moved(rolling(("constant", 1e-3), ("critical_share", 0.1))), "no rolling dashpot"),
        ("yade", moved(rolling(("constant", 1e-3), twisting=contact_scenes.JOINT)), "not joint"),
        ("lammps", moved(rolling(("constant", 1e-3), twisting=contact_scenes.JOINT)), "joins it to rolling"),
        ("lammps", moved(rolling(("constant", 1e-3), limit="unlimited")), "LAMMPS caps rolling torques"),
        ("yade", moved(contact_scenes.ConstantTorque("constant_torque", False)), "constant_torque has no translation"),
        ("liggghts", dmt("default", False), "normal law dmt has no translation in LIGGGHTS"),
        ("lammps", dmt("default", True), "a variable that it never sets"),
        ("lammps", dmt("on", False), "does not limit the damping of dmt"),
        ("yade", dmt("on", False), "limits the dashpot of DMT"),
        ("lammps", contact_scenes.luding_scenes()["part"], "luding_hysteretic has no translation in LAMMPS"),
    ],
)
def test_what_a_code_has_no_form_for_is_not_comparable(code: str, whole: Scene, reason: str) -> None:
    with pytest.raises(NotComparable, match=reason):
        ADAPTERS[code].deck(whole)


@pytest.mark.parametrize("code", list(ADAPTERS))
def test_friction_that_is_missing_or_negative_is_refused(code: str) -> None:
    for value in (None, -0.1):
        whole = FRICTION["mindlin/floor"]
        pairs = tuple(replace(pair, friction=value) for pair in whole.pairs)
        with pytest.raises(InvalidScene, match="friction = "):
            ADAPTERS[code].deck(replace(whole, pairs=pairs))
