"""OVITO and LAMMPS: text dumps of particles (`dump custom`) and of contacts (`dump local`).

Ids count from 1, as LAMMPS demands: particle i of the record is atom i + 1. Along a periodic axis positions are wrapped
into the box and image flags tell the rest; elsewhere they are those of the record. Numbers have 17 significant digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from numpy.typing import NDArray

from cross_check.export.trajectory import Contacts, Trajectory
from cross_check.record import Array

AnyArray = NDArray[Any]
#: Names that LAMMPS and OVITO know; a field that is not here goes by its own name.
NAMES = {
    "velocity": ("vx", "vy", "vz"),
    "angular_velocity": ("omegax", "omegay", "omegaz"),
    "force": ("fx", "fy", "fz"),
    "torque": ("tqx", "tqy", "tqz"),
}
BOUNDARY = {"open": "ff", "periodic": "pp"}


def write(trajectory: Trajectory, folder: Path) -> list[Path]:
    """Writes `particles.dump`, and `contacts.dump` and `body_contacts.dump` where the record has contacts."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "particles.dump"
    with path.open("w", encoding="utf-8") as file:
        for sample in range(trajectory.samples):
            _atoms(file, trajectory, sample)
    if not trajectory.has_contacts:
        return [path]
    pairs, bodies = folder / "contacts.dump", folder / "body_contacts.dump"
    with pairs.open("w", encoding="utf-8") as among, bodies.open("w", encoding="utf-8") as with_bodies:
        for sample in range(trajectory.samples):
            contacts = trajectory.contacts(sample)
            _entries(among, trajectory, sample, contacts.only(contacts.body < 0), "id2")
            _entries(with_bodies, trajectory, sample, contacts.only(contacts.body >= 0), "body")
    return [path, pairs, bodies]


def _header(file: TextIO, trajectory: Trajectory, sample: int, what: str, count: int, columns: list[str]) -> None:
    low, high, boundary = trajectory.box
    if sample == 0:
        file.write("ITEM: UNITS\nsi\n")
    file.write(f"ITEM: TIME\n{float(trajectory.record['time'][sample]):.17g}\n")
    file.write(f"ITEM: TIMESTEP\n{int(trajectory.record.step[sample])}\nITEM: NUMBER OF {what}\n{count}\n")
    file.write(f"ITEM: BOX BOUNDS {' '.join(BOUNDARY[kind] for kind in boundary)}\n")
    file.writelines(f"{a:.17g} {b:.17g}\n" for a, b in zip(low, high, strict=True))
    file.write(f"ITEM: {what} {' '.join(columns)}\n")


def _atoms(file: TextIO, trajectory: Trajectory, sample: int) -> None:
    position, image = _wrapped(trajectory, sample)
    fields = {field.name: field.values[sample] for field in trajectory.fields()}
    kinds = fields.pop("material", np.zeros(trajectory.count, dtype=np.int64))
    names = ["id", "type"]
    columns: list[AnyArray] = [np.arange(1, trajectory.count + 1), kinds + 1]
    for name, values in {"position": position, **fields}.items():
        labels = ("x", "y", "z") if name == "position" else NAMES.get(name, tuple(f"{name}_{axis}" for axis in "xyz"))
        names += [name] if values.ndim == 1 else labels
        columns += [values] if values.ndim == 1 else _parts(values)
    if image is not None:
        names += ["ix", "iy", "iz"]
        columns += _parts(image)
    _header(file, trajectory, sample, "ATOMS", trajectory.count, names)
    _rows(file, columns)


def _parts(vectors: AnyArray) -> list[AnyArray]:
    return [vectors[:, place] for place in range(3)]


def _wrapped(trajectory: Trajectory, sample: int) -> tuple[Array, NDArray[np.int64] | None]:
    """Positions in the box [m] (N, 3), and how many boxes each runs ahead (N, 3) where an axis is periodic."""
    low, high, boundary = trajectory.box
    position, length = trajectory.record["position"][sample], high - low
    if "periodic" not in boundary:
        return position, None
    periodic = np.array([kind == "periodic" for kind in boundary])
    image = np.where(periodic, np.floor((position - low) / length), 0.0).astype(np.int64)
    return position - image * length, image


def _entries(file: TextIO, trajectory: Trajectory, sample: int, contacts: Contacts, other: str) -> None:
    number = contacts.body if other == "body" else contacts.second
    names = ["id1", other, "x1", "y1", "z1", "x2", "y2", "z2", "fx", "fy", "fz", "normal_force", "tangential_force"]
    columns: list[AnyArray] = [contacts.first + 1, number + 1]
    columns += [part for vectors in (contacts.start, contacts.end, contacts.force) for part in _parts(vectors)]
    columns += [contacts.normal_force, contacts.tangential_force]
    _header(file, trajectory, sample, "ENTRIES", len(contacts), names)
    _rows(file, columns)


def _rows(file: TextIO, columns: Sequence[AnyArray]) -> None:
    """Writes columns of equal length as lines of numbers."""
    form = " ".join("%d" if np.issubdtype(column.dtype, np.integer) else "%.17g" for column in columns) + "\n"
    file.writelines(form % row for row in zip(*(column.tolist() for column in columns), strict=True))
