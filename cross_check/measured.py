"""Measured records: what is kept of a bulk run, observables over time in place of particles (docs/formats.md).

A folder with `measured.json` (header, stages, units) and `series.npz` (times, stages and one array per observable).
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cross_check.record import Array, Code, Header, RecordError

SCHEMA = 1
FILE = "measured.json"
KEYS = {"schema", "header", "stages", "observables"}
TIME, STAGE = "time", "stage"
PER_PARTICLE = ("mass", "radius")  # kept beside the series, where equal values take no room
RESERVED = (TIME, STAGE, *PER_PARTICLE)


@dataclass(frozen=True)
class Measured:
    """Observables of one run of one scene by one source.

    `time` [s], shape (T,), increases; `stage` is the index into `stages` of the stage in which a sample was taken,
    shape (T,), and does not decrease. `series` holds (T,) or (T, K) per observable, NaN where it is not defined,
    `units` the unit of each.
    """

    header: Header
    time: Array
    stage: NDArray[np.int64]
    stages: tuple[str, ...]
    series: dict[str, Array]
    units: dict[str, str]

    def __getitem__(self, observable: str) -> Array:
        """The series of an observable. Raises RecordError with the known ones."""
        if observable not in self.series:
            raise RecordError(f"{self.name}: no observable {observable} (known: {', '.join(self.series) or 'none'})")
        return self.series[observable]

    @property
    def name(self) -> str:
        """Which run this is, for messages."""
        header = self.header
        seed = "" if header.seed is None else f"/seed={header.seed}"
        variant = f"/{header.variant}" if header.variant else ""
        return f"{header.source} of {header.case}{variant}{seed}"

    def scalars(self) -> Measured:
        """The record without the observables that are lists of numbers at each time."""
        kept = {name: values for name, values in self.series.items() if values.ndim == 1}
        return replace(self, series=kept, units={name: self.units[name] for name in kept})

    def samples_of(self, stage: str) -> slice:
        """The samples of a stage. Raises RecordError with the known stages, or where it has no samples."""
        if stage not in self.stages:
            raise RecordError(f"{self.name}: no stage {stage} (known: {', '.join(self.stages)})")
        first, last = np.searchsorted(self.stage, (self.stages.index(stage), self.stages.index(stage) + 1))
        if first == last:
            raise RecordError(f"{self.name}: stage {stage} has no samples")
        return slice(int(first), int(last))

    def curve(self, observable: str, stage: str) -> tuple[Array, Array]:
        """Times (S,) [s] since the beginning of the run and values (S,) or (S, K) of an observable in a stage."""
        chosen = self.samples_of(stage)
        return self.time[chosen], self[observable][chosen]

    def values(self, observable: str, stage: str, average: float) -> Array:
        """Means over the last share `average` (0 to 1) of the samples of a stage, shape () or (K,).

        A share of less than one sample, such as 0, is the last sample. Of a list, parts that are not defined are NaN.
        """
        if not 0.0 <= average <= 1.0:
            raise RecordError(f"{self.name}: average {average}, expected a share from 0 to 1")
        _, values = self.curve(observable, stage)
        # Rounding must not turn 0.1 of 100 samples into 11.
        count = max(1, math.ceil(average * len(values) - 1e-9))
        if values.ndim == 1 and np.any(np.isnan(values[-count:])):
            raise RecordError(f"{self.name}: {observable} is not defined in all of the last {count} samples of {stage}")
        return np.asarray(np.mean(values[-count:], axis=0), dtype=float)

    def value(self, observable: str, stage: str, average: float) -> float:
        """The mean of a scalar observable over the last share `average` of the samples of a stage."""
        found = self.values(observable, stage, average)
        if found.ndim:
            raise RecordError(f"{self.name}: {observable} has {len(found)} components, expected a scalar")
        return float(found)

    def digest(self) -> str:
        """Hash of what was measured: times, stages, names, units and every bit of the series.

        The machine, the wall time and the compression have no part in it.
        """
        found = hashlib.blake2b(digest_size=16)
        found.update(json.dumps([SCHEMA, self.stages, sorted(self.units.items())]).encode())
        for name, array in sorted({**self.series, TIME: self.time, STAGE: self.stage}.items()):
            found.update(f"{name}:{array.shape}:".encode())
            found.update(np.ascontiguousarray(array, dtype="<i8" if name == STAGE else "<f8").tobytes())
        return found.hexdigest()

    def check(self, where: str, known: Mapping[str, str] | None = None) -> None:
        """Raises RecordError unless the record is complete, of one length, and nowhere infinite.

        `known` has the unit of every observable that there is; without it any name is allowed.
        """
        _check_samples(self, where)
        for name in self.series:
            if name in RESERVED:
                raise RecordError(f"{where}: observable {name} has a reserved name (reserved: {', '.join(RESERVED)})")
            if name not in self.units:
                raise RecordError(f"{where}: observable {name} has no unit")
            if known is not None and name not in known:
                raise RecordError(f"{where}: unknown observable {name} (known: {', '.join(known)})")
            if known is not None and known[name] != self.units[name]:
                raise RecordError(f"{where}: observable {name} is in {self.units[name]}, expected {known[name]}")
        for name in self.units:
            if name not in self.series:
                raise RecordError(f"{where}: observable {name} has a unit and no series")
        for name, array in self.series.items():
            if array.ndim not in (1, 2) or len(array) != len(self.time):
                samples = len(self.time)
                raise RecordError(
                    f"{where}: observable {name} has shape {array.shape}, expected ({samples},) or ({samples}, K)"
                )
            if np.any(np.isinf(array)):
                bad = int(np.argwhere(np.isinf(array))[0][0])
                raise RecordError(f"{where}: observable {name} is infinite at time {self.time[bad]} s")

    def write(self, folder: Path) -> None:
        """Checks the record and writes `measured.json` and `series.npz` into `folder`."""
        self.check(str(folder))
        folder.mkdir(parents=True, exist_ok=True)
        header = self.header.to_dict()
        columns = {key: np.asarray(header.pop(key), dtype=float) for key in PER_PARTICLE}
        np.savez_compressed(
            folder / "series.npz", allow_pickle=False, time=self.time, stage=self.stage, **columns, **self.series
        )
        content = {"schema": SCHEMA, "header": header, "stages": self.stages, "observables": self.units}
        (folder / FILE).write_text(json.dumps(content, indent=1, sort_keys=True) + "\n")


def _check_samples(record: Measured, where: str) -> None:
    """Raises RecordError unless times and stages are those of one run."""
    samples = len(record.time)
    if record.time.ndim != 1 or samples == 0:
        raise RecordError(f"{where}: times of shape {record.time.shape}, expected at least one sample")
    if not np.all(np.isfinite(record.time)) or np.any(np.diff(record.time) <= 0.0):
        raise RecordError(f"{where}: times are not finite and increasing")
    if record.stage.shape != (samples,) or not np.issubdtype(record.stage.dtype, np.integer):
        raise RecordError(
            f"{where}: stages of shape {record.stage.shape} and type {record.stage.dtype}, expected one index for each "
            f"of {samples} samples"
        )
    if len(set(record.stages)) != len(record.stages):
        raise RecordError(f"{where}: two stages have the same name: {', '.join(record.stages)}")
    if record.stage[0] < 0 or record.stage[-1] >= len(record.stages) or np.any(np.diff(record.stage) < 0):
        raise RecordError(f"{where}: stages of samples do not count up within the {len(record.stages)} stages")


def read(folder: Path, known: Mapping[str, str] | None = None) -> Measured:
    """Reads and checks a folder. Raises RecordError with the file and the reason; `known` as for `Measured.check`."""
    path = folder / FILE
    try:
        raw: dict[str, Any] = json.loads(path.read_text())
        if raw.get("schema") != SCHEMA:
            raise RecordError(f"{path}: schema {raw.get('schema')!r}, this version reads schema {SCHEMA}")
        odd = sorted(set(raw) ^ KEYS)
        if odd:
            raise RecordError(
                f"{path}: keys {', '.join(odd)} are unknown or missing (known: {', '.join(sorted(KEYS))})"
            )
        # An archive that is cut short leaves no file open this way.
        with (folder / "series.npz").open("rb") as file, np.load(file) as data:
            series = {name: data[name] for name in data.files}
        per_particle = {key: [float(value) for value in series.pop(key)] for key in PER_PARTICLE}
        content: dict[str, Any] = {**raw["header"], **per_particle, "code": Code(**raw["header"]["code"])}
        header = Header(**content)
        time, stage = series.pop(TIME), series.pop(STAGE)
        record = Measured(header, time, stage, tuple(raw["stages"]), series, dict(raw["observables"]))
    except RecordError:
        raise
    except FileNotFoundError as error:
        raise RecordError(f"{error.filename}: no such file") from error
    except Exception as error:  # a truncated or foreign file raises many kinds of errors: one message for all
        raise RecordError(f"{folder}: not a readable measured record ({error!r})") from error
    record.check(str(folder), known)
    return record
