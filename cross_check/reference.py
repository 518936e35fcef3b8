"""Reference data: closed forms (`reference/analytic`) and recorded runs (`reference/recorded`)."""

from __future__ import annotations

import functools
import hashlib
import importlib.util
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from cross_check import PACKAGE
from cross_check.measured import FILE as MEASURED
from cross_check.measured import Measured
from cross_check.measured import read as read_measured
from cross_check.record import RecordError, RunRecord, read
from cross_check.scene import Scene

FOLDER = PACKAGE.parent / "reference"

ClosedForm = Callable[..., Any]


@functools.cache
def closed_forms() -> dict[str, ClosedForm]:
    """Every closed form by `module.name`: scalars take a scene, series a scene and steps."""
    forms: dict[str, ClosedForm] = {}
    for path in sorted((FOLDER / "analytic").glob("*.py")):
        spec = importlib.util.spec_from_file_location(f"crossgrain_reference_{path.stem}", path)
        if spec is None or spec.loader is None:
            raise RecordError(f"{path}: not a module")
        module = importlib.util.module_from_spec(spec)
        # Dataclasses look their module up by name.
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
        for name, form in module.CLOSED_FORMS.items():
            forms[f"{path.stem}.{name}"] = form
    return forms


def recorded(code: str, deck_hash: str) -> Path | None:
    """Folder of the recorded run of a deck by the newest recorded version of a code, or None."""
    found = sorted((FOLDER / "recorded" / code).glob(f"*/{deck_hash}/record.json"))
    return found[-1].parent if found else None


def _measured_folder(code: str, version: str, deck_hash: str, scene: Scene) -> Path:
    """Where the measured record of a deck lies: what is measured is part of its name."""
    observables = hashlib.blake2b(json.dumps(scene.observables, sort_keys=True).encode(), digest_size=4).hexdigest()
    return FOLDER / "recorded" / code / version / "measured" / f"{deck_hash}-{observables}"


def recorded_measured(code: str, deck_hash: str, scene: Scene) -> Path | None:
    """Folder of the measured record of a deck by the newest recorded version of a code, or None."""
    pattern = _measured_folder(code, "*", deck_hash, scene).relative_to(FOLDER)
    found = sorted(FOLDER.glob(f"{pattern}/measured.json"))
    return found[-1].parent if found else None


def store_measured(record: Measured, scene: Scene) -> Path:
    """Writes what was measured of a run into `reference/recorded` and returns its folder.

    Lists of numbers at each time are left out, because they are large. A stored record of the same bits stays as it is.
    """
    header = record.header
    kept = record.scalars()
    folder = _measured_folder(header.source, slug(header.code.version), header.deck_hash, scene)
    if (folder / MEASURED).is_file() and read_measured(folder).digest() == kept.digest():
        return folder
    kept.write(folder)
    return folder


def slug(version: str) -> str:
    """A version as a folder name."""
    return "".join(c if c.isalnum() or c in ".-" else "-" for c in version)


def thin(record: RunRecord, samples: int = 100) -> RunRecord:
    """The record as it is stored: about `samples` samples, and all those that quantities are interpolated from.

    Kept are the neighbours of the largest force of every particle, of the extremes of its components and of every
    beginning and end of a contact, so that peaks, pulls, durations and rebounds are those of the full record.
    """
    force = np.linalg.norm(record["force"], axis=2)
    kept = set(range(0, len(record.step), max(1, len(record.step) // samples)))
    marks = [int(index) for index in np.argmax(force, axis=0)]
    marks += [int(index) for extreme in (np.argmin, np.argmax) for index in extreme(record["force"], axis=0).flat]
    marks += [int(index) for index in np.flatnonzero(np.diff((force > 0.0).any(axis=1).astype(int)))]
    marks += [0, len(record.step) - 1]
    for mark in marks:
        kept.update(range(mark - 2, mark + 4))
    chosen = np.array(sorted(index for index in kept if 0 <= index < len(record.step)))
    return RunRecord(record.header, {name: column[chosen] for name, column in record.columns.items()})


def store(record: RunRecord, code: str) -> Path:
    """Writes a thinned record into `reference/recorded` and returns its folder.

    A stored record with the same columns stays as it is: only what changed is a diff to review.
    """
    header, thinned = record.header, thin(record)
    folder = FOLDER / "recorded" / code / slug(header.code.version) / header.deck_hash
    if (folder / "record.json").is_file():
        stored = read(folder)
        same = stored.columns.keys() == thinned.columns.keys()
        if same and all(np.array_equal(stored[name], column) for name, column in thinned.columns.items()):
            return folder
    thinned.write(folder)
    return folder
