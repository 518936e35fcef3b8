"""Rolling and twisting in the real codes against their mirrors: whole histories of force and torque."""

from __future__ import annotations

from pathlib import Path

import pytest

from cross_check.adapters import ADAPTERS
from cross_check.record import RunRecord
from cross_check.scene import Scene

from . import contact_scenes, scenes
from .test_friction import check_history, run_all

LAWS = contact_scenes.moment_laws()
NAMES = [(code, name, place) for code, laws in LAWS.items() for name in laws for place in ("pair", "floor")]


def scene_of(code: str, name: str, place: str) -> Scene:
    """A collision under one moment law."""
    whole = scenes.oblique_pair() if place == "pair" else contact_scenes.spinning_floor()
    # A whole spin that stops in the middle of a collision would reverse at every step, by rounding.
    rolls = 0.02 if name == "cdt/torsion" else 0.2
    return contact_scenes.with_moments(whole, LAWS[code][name], f"{name}/{place}", rolls=rolls)


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[str, str, str], RunRecord]:
    """Every scene of every installed code."""
    found: dict[tuple[str, str, str], RunRecord] = {}
    for code, adapter in ADAPTERS.items():
        if adapter.installed() is None:
            continue
        wanted = {f"{name}/{place}": scene_of(code, name, place) for c, name, place in NAMES if c == code}
        for key, record in run_all(code, wanted, tmp_path_factory).items():
            name, place = key.rsplit("/", 1)
            found[code, name, place] = record
    return found


@pytest.mark.parametrize(("code", "name", "place"), NAMES)
def test_force_and_torque_histories_are_the_mirror(
    code: str, name: str, place: str, records: dict[tuple[str, str, str], RunRecord], tmp_path: Path
) -> None:
    if (code, name, place) not in records:
        pytest.skip(f"{code} is not installed")
    check_history(records[code, name, place], scene_of(code, name, place), code, tmp_path)
