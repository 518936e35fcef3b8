"""The run record: one neutral, versioned form for the results of every code (docs/formats.md)."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SCHEMA = 1
UNITS = {
    "step": "-",
    "time": "s",
    "position": "m",
    "velocity": "m/s",
    "angular_velocity": "rad/s",
    "force": "N",
    "torque": "N m",
    "body_force": "N",
    "body_point": "m",
    "temperature": "K",
    "radius": "m",
    "law_state": "SI",
    "contact_start": "-",
    "contact_pair": "-",
    "contact_force": "N",
    "contact_elastic": "N",
    "contact_limit": "N",
    "contact_memory": "SI",
    "energy_kinetic": "J",
    "energy_elastic": "J",
    "energy_gravity": "J",
    "energy_viscous": "J",
    "energy_frictional": "J",
    "energy_rolling": "J",
    "energy_plastic": "J",
    "energy_carried": "J",
    "energy_body_work": "J",
    "energy_entered": "J",
}
CONTACTS = ("contact_start", "contact_pair", "contact_force")
# What contacts remember and the parts of their forces, which stand beside the others or not at all.
CONTACT_STATES = ("contact_elastic", "contact_limit", "contact_memory")
DISSIPATED = ("energy_viscous", "energy_frictional", "energy_rolling", "energy_plastic", "energy_carried")
REQUIRED = ("step", "time", "position", "velocity", "angular_velocity", "force", "torque")


class RecordError(Exception):
    """A record that cannot be trusted: the message names the file, what is wrong and what is allowed."""


@dataclass(frozen=True)
class Code:
    """Which program made a record: `name`, its own `version`, and the `package` that brought it."""

    name: str
    version: str
    package: str


@dataclass(frozen=True)
class Header:
    """What a record is a record of. Times in s, masses in kg, radii in m.

    `law_state` names the numbers of the column of that name, with their units.
    """

    source: str
    case: str
    variant: str
    seed: int | None
    refinement: int
    code: Code
    deck_hash: str
    machine: str
    wall_time: float
    time_step: float
    steps: int
    velocity_time: str
    contact_force: str
    mass: list[float]
    radius: list[float]
    bodies: list[str]
    gravity: list[float]
    schema: int = SCHEMA
    columns: dict[str, str] = field(default_factory=dict[str, str])
    law_state: list[list[str]] = field(default_factory=list[list[str]])

    def to_dict(self) -> dict[str, Any]:
        """The header as files hold it."""
        raw = asdict(self)
        if not self.law_state:
            del raw["law_state"]
        return raw


@dataclass(frozen=True)
class RunRecord:
    """Header and columns of one run of one scene by one source. Shapes and units: docs/formats.md."""

    header: Header
    columns: dict[str, NDArray[Any]]

    def __getitem__(self, name: str) -> Array:
        return self.columns[name]

    @property
    def step(self) -> NDArray[np.int64]:
        """Sampled steps, shape (T,) [-]."""
        return self.columns["step"]

    def synchronized_velocity(self) -> Array:
        """Velocities at the times of the positions, shape (T, N, 3) [m/s].

        A half-step record holds v(n + 1/2) = v(n) + a(n) dt / 2, which defines v(n); a is force over
        mass plus gravity, because the force column holds no weight.
        """
        velocity = self.columns["velocity"]
        if self.header.velocity_time == "synchronized":
            return velocity
        mass = np.asarray(self.header.mass)[None, :, None]
        acceleration = self.columns["force"] / mass + np.asarray(self.header.gravity)
        return velocity - 0.5 * self.header.time_step * acceleration

    def synchronized_spin(self, moment_of_inertia: Array) -> Array:
        """Angular velocities at the times of the positions, shape (T, N, 3) [rad/s], of spheres of given inertia."""
        spin = self.columns["angular_velocity"]
        if self.header.velocity_time == "synchronized":
            return spin
        return spin - 0.5 * self.header.time_step * self.columns["torque"] / moment_of_inertia[None, :, None]

    def check(self, where: str) -> None:
        """Raises RecordError unless the record is complete, finite and of one shape."""
        for name in REQUIRED:
            if name not in self.columns:
                raise RecordError(f"{where}: column {name} is missing")
        samples, count = len(self.step), len(self.header.mass)
        if samples == 0:
            raise RecordError(f"{where}: the record holds no samples")
        if int(self.step[-1]) != self.header.steps:
            raise RecordError(
                f"{where}: the last sample is step {int(self.step[-1])}, the run has {self.header.steps} steps"
            )
        if np.any(np.diff(self.step) <= 0):
            raise RecordError(f"{where}: steps do not increase")
        for name, column in self.columns.items():
            if name not in UNITS:
                raise RecordError(f"{where}: unknown column {name} (known: {', '.join(UNITS)})")
            of_contacts = name in (*CONTACTS, *CONTACT_STATES)
            if not of_contacts and len(column) != samples:
                raise RecordError(f"{where}: column {name} has {len(column)} samples, step has {samples}")
            if not np.all(np.isfinite(column)):
                bad = int(np.argwhere(~np.isfinite(column))[0][0])
                place = f"row {bad}" if of_contacts else f"step {int(self.step[bad])}"
                raise RecordError(f"{where}: column {name} is not a finite number at {place}")
        shapes = dict.fromkeys(REQUIRED[2:], (samples, count, 3))
        shapes |= dict.fromkeys(("body_force", "body_point"), (samples, len(self.header.bodies), 3))
        shapes |= {"temperature": (samples,), "radius": (samples, count)}
        shapes |= {"law_state": (samples, len(self.header.law_state))}
        for name, shape in shapes.items():
            if name in self.columns and self.columns[name].shape != shape:
                raise RecordError(f"{where}: column {name} has shape {self.columns[name].shape}, expected {shape}")
        if any(name in self.columns for name in (*CONTACTS, *CONTACT_STATES)):
            self._check_contacts(where, samples, count)

    def _check_contacts(self, where: str, samples: int, count: int) -> None:
        """Contacts stand sample after sample: `contact_start` says where each sample begins."""
        for name in CONTACTS:
            if name not in self.columns:
                raise RecordError(f"{where}: column {name} is missing")
        start, pair, force = (self.columns[name] for name in CONTACTS)
        if start.shape != (samples + 1,) or start[0] != 0 or np.any(np.diff(start) < 0):
            raise RecordError(f"{where}: column contact_start does not rise from 0 over {samples + 1} entries")
        rows = int(start[-1])
        if pair.shape != (rows, 2) or force.shape != (rows, 3):
            raise RecordError(
                f"{where}: contact columns have shapes {pair.shape} and {force.shape} for {rows} contacts"
            )
        if rows and (
            pair.min() < 0 or pair[:, 0].max() >= count or pair[:, 1].max() >= count + len(self.header.bodies)
        ):
            raise RecordError(f"{where}: column contact_pair names particles or bodies that are not there")
        if any(name in self.columns for name in CONTACT_STATES):
            self._check_contact_states(where, rows)

    def _check_contact_states(self, where: str, rows: int) -> None:
        """Each contact has an elastic force, a limit of friction and a list of numbers that it remembers."""
        for name in CONTACT_STATES:
            if name not in self.columns:
                raise RecordError(f"{where}: column {name} is missing")
            shape, dimensions = self.columns[name].shape, 2 if name == "contact_memory" else 1
            if len(shape) != dimensions or shape[0] != rows:
                raise RecordError(f"{where}: column {name} has shape {shape} for {rows} contacts")

    def write(self, folder: Path, *, compress: bool = True) -> None:
        """Writes `record.json` and `columns.npz` into `folder`."""
        folder.mkdir(parents=True, exist_ok=True)
        save = np.savez_compressed if compress else np.savez
        save(folder / "columns.npz", allow_pickle=False, **self.columns)
        header = self.header.to_dict() | {"columns": {name: UNITS[name] for name in self.columns}}
        (folder / "record.json").write_text(json.dumps(header, indent=1, sort_keys=True) + "\n")


def read(folder: Path) -> RunRecord:
    """Reads and checks a record folder. Raises RecordError with the file and the reason."""
    path = folder / "record.json"
    try:
        raw: dict[str, Any] = json.loads(path.read_text())
        if raw.get("schema") != SCHEMA:
            raise RecordError(f"{path}: schema {raw.get('schema')!r}, this version reads schema {SCHEMA}")
        raw["code"] = Code(**raw["code"])
        header = Header(**raw)
        # An archive that is cut short leaves no file open this way.
        with (folder / "columns.npz").open("rb") as file, np.load(file) as data:
            columns = {name: data[name] for name in data.files}
    except RecordError:
        raise
    except FileNotFoundError as error:
        raise RecordError(f"{error.filename}: no such file") from error
    except Exception as error:  # a truncated or foreign file raises many kinds of errors: one message for all
        raise RecordError(f"{folder}: not a readable run record ({error})") from error
    record = RunRecord(header, columns)
    record.check(str(folder))
    if not math.isfinite(header.time_step):
        raise RecordError(f"{path}: time_step is not a finite number")
    return record
