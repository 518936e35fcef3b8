"""Reads what a YADE deck wrote, strictly: a row that is not as ordered is an error with its file and line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cross_check.adapters.interface import RunFailed
from cross_check.adapters.rows import number_rows
from cross_check.adapters.runner import Columns
from cross_check.adapters.yade.translate import PARTICLE_COLUMNS, PARTICLES, WALL_COLUMNS, WALLS
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
    return columns


def read_table(path: Path, columns: tuple[str, ...], scene: Scene, ids: range) -> Array:
    """Rows of a table with a line of names, shape (T, len(ids), C). Raises RunFailed."""
    try:
        lines = path.read_bytes().split(b"\n")
    except FileNotFoundError:
        raise RunFailed(f"{path}: the run wrote no such file") from None
    head = " ".join(columns).encode()
    if lines[0] != head:
        raise RunFailed(f"{path}:1: {lines[0].decode(errors='replace')!r} in place of {head.decode()!r}")
    steps = np.arange(0, scene.steps + 1, scene.output_every)
    wanted = len(steps) * len(ids)
    values = number_rows(lines[1:-1], len(columns))
    if values is None:
        bad = next(k for k, line in enumerate(lines[1:-1]) if number_rows([line], len(columns)) is None)
        text = lines[1 + bad].decode(errors="replace")
        raise RunFailed(f"{path}:{bad + 2}: not {len(columns)} finite numbers: {text!r}")
    if len(values) != wanted or lines[-1] != b"":
        raise RunFailed(f"{path}:{len(lines)}: the file ends after {len(values)} of {wanted} rows")
    table: Array = np.reshape(values, (len(steps), len(ids), len(columns)))
    order = (table[:, :, 0] == steps[:, None]) & (table[:, :, 1] == np.array(ids))
    if not np.all(order):
        bad = int(np.flatnonzero(~order.ravel())[0])
        raise RunFailed(f"{path}:{bad + 2}: step or id out of order")
    return table
