"""Reads what a YADE deck wrote, strictly: a row that is not as ordered is an error with its file and line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cross_check.adapters.contacts import Rows, contact_columns
from cross_check.adapters.interface import RunFailed
from cross_check.adapters.rows import number_rows
from cross_check.adapters.runner import Columns
from cross_check.adapters.yade.translate import (
    CONTACT_COLUMNS,
    CONTACTS,
    PARTICLE_COLUMNS,
    PARTICLES,
    WALL_COLUMNS,
    WALLS,
)
from cross_check.scene import Scene

Array = NDArray[np.float64]


def read_run(folder: Path, scene: Scene) -> Columns:
    """Columns of a run record from the files of a deck in `folder`; velocities are those of step n + 1/2."""
    count, bodies = len(scene.particles), len(scene.bodies)
    rows = read_table(folder / PARTICLES, PARTICLE_COLUMNS, scene, range(count))
    columns: Columns = {
        "position": rows[:, :, 2:5],
        "velocity": rows[:, :, 5:8],
        "angular_velocity": rows[:, :, 8:11],
        "force": rows[:, :, 11:14],
        "torque": rows[:, :, 14:17],
    }
    if bodies:
        columns["body_force"] = read_table(folder / WALLS, WALL_COLUMNS, scene, range(count, count + bodies))[:, :, 2:5]
    if scene.contacts:
        columns |= contact_columns(folder / CONTACTS, len(rows), [read_contacts(folder / CONTACTS, scene)])
    return columns


def read_table(path: Path, columns: tuple[str, ...], scene: Scene, ids: range) -> Array:
    """Rows of a table with a line of names, shape (T, len(ids), C). Raises RunFailed."""
    values = _numbers(path, columns)
    steps = np.arange(0, scene.steps + 1, scene.output_every)
    wanted = len(steps) * len(ids)
    if len(values) != wanted:
        raise RunFailed(f"{path}:{len(values) + 2}: the file ends after {len(values)} of {wanted} rows")
    table: Array = np.reshape(values, (len(steps), len(ids), len(columns)))
    order = (table[:, :, 0] == steps[:, None]) & (table[:, :, 1] == np.array(ids))
    if not np.all(order):
        bad = int(np.flatnonzero(~order.ravel())[0])
        raise RunFailed(f"{path}:{bad + 2}: step or id out of order")
    return table


def read_contacts(path: Path, scene: Scene) -> Rows:
    """Contacts of every sample; YADE's force is that on the second side. Raises RunFailed."""
    values = _numbers(path, CONTACT_COLUMNS)
    step, ids = values[:, 0], values[:, 1:3]
    sides = len(scene.particles) + len(scene.bodies)
    wrong = (step % scene.output_every != 0) | (step < 0) | (step > scene.steps) | (np.diff(step, prepend=0.0) < 0)
    wrong |= np.any((ids % 1 != 0) | (ids < 0) | (ids >= sides), axis=1) | (ids[:, 0] == ids[:, 1])
    if np.any(wrong):
        raise RunFailed(f"{path}:{int(np.flatnonzero(wrong)[0]) + 2}: step or ids are not those of a sample")
    return Rows((step // scene.output_every).astype(np.int64), ids.astype(np.int64), -values[:, 3:])


def _numbers(path: Path, columns: tuple[str, ...]) -> Array:
    """Rows below a line of names, shape (M, C). Raises RunFailed."""
    try:
        lines = path.read_bytes().split(b"\n")
    except FileNotFoundError:
        raise RunFailed(f"{path}: the run wrote no such file") from None
    head = " ".join(columns).encode()
    if lines[0] != head:
        raise RunFailed(f"{path}:1: {lines[0].decode(errors='replace')!r} in place of {head.decode()!r}")
    values = number_rows(lines[1:-1], len(columns))
    if values is None:
        bad = next(k for k, line in enumerate(lines[1:-1]) if number_rows([line], len(columns)) is None)
        text = lines[1 + bad].decode(errors="replace")
        raise RunFailed(f"{path}:{bad + 2}: not {len(columns)} finite numbers: {text!r}")
    if lines[-1] != b"":
        raise RunFailed(f"{path}:{len(lines)}: the file ends after {len(values)} whole rows, within a line")
    return values
