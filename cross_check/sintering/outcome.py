"""What became of a run: its numbers and arrays, kept in two files, or the reason why there are none."""

from __future__ import annotations

import json
import math
import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cross_check.sintering.plan import Run

SCHEMA = 1
Arrays = dict[str, NDArray[Any]]
Numbers = dict[str, float]


@dataclass(frozen=True)
class Outcome:
    """Numbers by name (docs/sintering.md), arrays for figures, and where they come from.

    `failure` is empty where there are numbers. `origin` is `live` or `kept`. `wall_time` [s], `time_step` [s].
    """

    run: Run
    numbers: Numbers = field(default_factory=dict[str, float])
    arrays: Arrays = field(default_factory=dict[str, NDArray[Any]])
    failure: str = ""
    origin: str = "live"
    wall_time: float = 0.0
    steps: int = 0
    time_step: float = 0.0
    machine: str = ""


def keep(outcome: Outcome, folder: Path, key: str) -> None:
    """Writes `KEY.npz` and then `KEY.json`, each beside its place first: a run that is stopped leaves no half of it."""
    folder.mkdir(parents=True, exist_ok=True)
    scratch = folder / f"{key}.npz.new"
    with scratch.open("wb") as file:
        np.savez_compressed(file, allow_pickle=False, **outcome.arrays)
    scratch.replace(folder / f"{key}.npz")
    content = {
        "schema": SCHEMA,
        "run": outcome.run.name,
        "wall_time": outcome.wall_time,
        "steps": outcome.steps,
        "time_step": outcome.time_step,
        "machine": outcome.machine,
        "numbers": {name: value if math.isfinite(value) else str(value) for name, value in outcome.numbers.items()},
    }
    scratch = folder / f"{key}.json.new"
    with scratch.open("w", encoding="utf-8") as file:
        json.dump(content, file, indent=1, allow_nan=False)
        file.write("\n")
        file.flush()
        os.fsync(file.fileno())
    scratch.replace(folder / f"{key}.json")


def kept(run: Run, folder: Path, key: str) -> Outcome | None:
    """What was kept under a key, or None; a damaged entry counts as none."""
    try:
        raw: Mapping[str, Any] = json.loads((folder / f"{key}.json").read_text(encoding="utf-8"))
        if raw["schema"] != SCHEMA:
            return None
        numbers = {name: float(value) for name, value in raw["numbers"].items()}
        with (folder / f"{key}.npz").open("rb") as file, np.load(file) as data:
            arrays = {name: data[name] for name in data.files}
        origin = {name: raw[name] for name in ("wall_time", "steps", "time_step", "machine")}
    except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile):
        return None
    return Outcome(run, numbers, arrays, origin="kept", **origin)
