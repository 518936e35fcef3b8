"""Decks of every case and code: byte for byte, reviewed like source. No external code is needed.

The whole deck of the first variant of each case is stored, and the hash of every other one; of a long file, such as the
start of many particles, its beginning and its length, for the hash covers the rest. Refresh them with
CROSSGRAIN_UPDATE_SNAPSHOTS=1.
"""

from __future__ import annotations

import functools
import json
import os
from pathlib import Path

import pytest

from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import Deck, NotComparable
from cross_check.suites import listed, named

SNAPSHOTS = Path(__file__).parent / "snapshots"
UPDATE = os.environ.get("CROSSGRAIN_UPDATE_SNAPSHOTS") == "1"
# Length up to which a file is stored whole.
LONG = 40_000
NAMES = [case.name for case in listed()]
case_of = functools.cache(named)


def shown(text: str) -> str:
    """A file of a deck as it is stored."""
    return text if len(text) <= LONG else f"{text[:2000]}\n... {len(text)} characters in all\n"


def decks(case: str, code: str) -> dict[str, Deck | str]:
    """Decks of all variants, or the reason why a variant has none."""
    found: dict[str, Deck | str] = {}
    for variant in case_of(case).variants:
        try:
            found[variant.member or case] = ADAPTERS[code].deck(variant.scenes[0])
        except NotComparable as reason:
            found[variant.member or case] = f"not-comparable({reason})"
    return found


@pytest.mark.parametrize("code", ADAPTERS)
@pytest.mark.parametrize("case", NAMES)
def test_decks_are_those_that_were_reviewed(case: str, code: str) -> None:
    found = decks(case, code)
    written = [deck for deck in found.values() if isinstance(deck, Deck)]
    texts = {f"{name}.txt": shown(text) for name, text in written[0].files.items()} if written else {}
    hashes = {variant: deck.hash if isinstance(deck, Deck) else deck for variant, deck in found.items()}
    texts["variants.json"] = json.dumps(hashes, indent=1) + "\n"
    folder = SNAPSHOTS / code / case
    if UPDATE:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
    stored = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
    assert texts == stored


@pytest.mark.parametrize("code", ADAPTERS)
@pytest.mark.parametrize("case", NAMES)
def test_decks_are_the_same_bytes_twice(case: str, code: str) -> None:
    first, second = decks(case, code), decks(case, code)
    for one, other in zip(first.values(), second.values(), strict=True):
        assert (one.files if isinstance(one, Deck) else one) == (other.files if isinstance(other, Deck) else other)
