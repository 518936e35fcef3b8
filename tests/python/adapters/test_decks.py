"""Decks byte for byte. CROSSGRAIN_UPDATE_SNAPSHOTS=1 writes them anew; review the difference like source."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from cross_check.adapters import ADAPTERS
from cross_check.scene import Scene

from . import beds, scenes

SNAPSHOTS = Path(__file__).parent / "snapshots"
SCENES = {
    "pair": scenes.pair(),
    "oblique": scenes.oblique_pair(),
    "floor": scenes.floor(),
    "corner": scenes.corner(),
    "rising": scenes.rising_floor(),
    "stages": beds.carried(),
    "bed": beds.silo(3, 5, 0.0112, 1000, 1000, 100),
}


@pytest.mark.parametrize("code", list(ADAPTERS))
@pytest.mark.parametrize("name", list(SCENES))
def test_deck_is_the_reviewed_one(code: str, name: str) -> None:
    for file, text in ADAPTERS[code].deck(SCENES[name]).files.items():
        path = SNAPSHOTS / code / name / f"{file}.txt"
        if os.environ.get("CROSSGRAIN_UPDATE_SNAPSHOTS"):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        assert text == path.read_text(), f"{path} differs from the deck of today"


@pytest.mark.parametrize("code", list(ADAPTERS))
@pytest.mark.parametrize("whole", SCENES.values(), ids=list(SCENES))
def test_deck_prints_its_translation(code: str, whole: Scene) -> None:
    deck = ADAPTERS[code].deck(whole)
    text = deck.files[deck.main]
    head = text[: text.index("\n\n")]
    for row in deck.translation:
        assert any(
            row.case_key in line and row.code_value in line and row.formula in line for line in head.splitlines()
        )


@pytest.mark.parametrize("code", list(ADAPTERS))
def test_deck_has_no_tabs_and_no_blanks_at_line_ends(code: str) -> None:
    deck = ADAPTERS[code].deck(scenes.floor())
    for line in deck.files[deck.main].splitlines():
        assert not line.endswith(" ")
        assert "\t" not in line
