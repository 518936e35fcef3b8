"""What every adapter of an external code provides. No adapter sees another."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from cross_check.record import Code, RunRecord
from cross_check.scene import Scene


@dataclass(frozen=True)
class Row:
    """One line of a translation: how a value of the case became a value of the deck.

    `case_key` and `case_value` are what the scene says, `code_key` and `code_value` what the deck says
    (numbers with 17 digits), `formula` how the one became the other, `unit` of the deck value.
    """

    case_key: str
    case_value: str
    code_key: str
    code_value: str
    unit: str
    formula: str


@dataclass(frozen=True)
class Deck:
    """Files of one input deck, byte-identical for the same scene, and the translation printed in their header."""

    code: str
    scene: Scene
    files: dict[str, str]
    main: str
    translation: list[Row] = field(default_factory=list[Row])

    @property
    def hash(self) -> str:
        """Hash over names and contents of all files, hexadecimal."""
        digest = hashlib.blake2b(digest_size=16)
        for name in sorted(self.files):
            for part in (name, self.files[name]):
                data = part.encode()
                digest.update(len(data).to_bytes(8, "little"))
                digest.update(data)
        return digest.hexdigest()


class InvalidScene(ValueError):
    """The scene contradicts itself or lacks what every code needs; the message names the key and what is allowed."""


class NotComparable(Exception):
    """The code has no form for what the scene states; the message is the reason, for people to read."""


class RunFailed(Exception):
    """The code did not deliver a record that can be trusted; the message says what happened and where its log is."""


@dataclass
class Adapter:
    """One external code: the functions of its folder under one name.

    `installed` gives the program with its version and package, or None. `deck` translates and renders; it raises
    NotComparable with the reason. `mirror` gives the same scene with the engine options that reproduce what the code
    computes. `run` runs decks headless, each in its own folder below the given one, with a time limit per deck [s], and
    gives one result per deck, in order; logs are captured in the deck's folder.
    """

    name: str
    proved_versions: tuple[str, ...]
    installed: Callable[[], Code | None]
    deck: Callable[[Scene], Deck]
    mirror: Callable[[Scene], Scene]
    run: Callable[[list[Deck], Path, float], list[RunRecord | RunFailed]]
