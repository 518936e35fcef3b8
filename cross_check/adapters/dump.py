"""The text dump that LIGGGHTS and LAMMPS share, read strictly: a frame not as ordered is an error with its line."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cross_check.adapters.contacts import Rows, contact_columns
from cross_check.adapters.interface import RunFailed
from cross_check.adapters.rows import number_rows
from cross_check.adapters.runner import Columns
from cross_check.adapters.stages import gravities
from cross_check.scene import Scene

Array = NDArray[np.float64]

HISTORY = "history.dump"
PARTICLES = "particles.dump"
CONTACTS = "contacts.dump"
STATE = ("xu", "yu", "zu", "vx", "vy", "vz", "omegax", "omegay", "omegaz", "fx", "fy", "fz", "tqx", "tqy", "tqz")
HEAD = 9
# A body's index and the three columns that hold its force on each particle.
Wall = tuple[int, tuple[str, str, str]]


def read_frames(path: Path, columns: Sequence[str], count: int, steps: Sequence[int]) -> Array:
    """Frames of `count` rows at the given `steps`, shape (T, N, C), `columns` as ordered. Raises RunFailed."""
    try:
        lines = path.read_bytes().split(b"\n")
    except FileNotFoundError:
        raise RunFailed(f"{path}: the run wrote no such file") from None
    length = HEAD + count
    whole = len(lines) == length * len(steps) + 1 and lines[-1] == b""
    if not (whole and _heads_are_right(lines, columns, count, steps)):
        raise RunFailed(_first_fault(path, lines, columns, count, steps))
    rows: list[Array] = []
    for row in range(HEAD, length):
        values = number_rows(lines[row::length], len(columns))
        if values is None:
            raise RunFailed(_first_fault(path, lines, columns, count, steps))
        rows.append(values)
    return np.stack(rows, axis=1)


def _head(columns: Sequence[str], count: int) -> dict[int, bytes]:
    """The lines of a frame's head that are fixed, by their place in the frame; blanks at the end do not count."""
    return {
        0: b"ITEM: TIMESTEP",
        2: b"ITEM: NUMBER OF ATOMS",
        3: b"%d" % count,
        8: b"ITEM: ATOMS " + " ".join(columns).encode(),
    }


def _heads_are_right(lines: list[bytes], columns: Sequence[str], count: int, steps: Sequence[int]) -> bool:
    length = HEAD + count
    for place, text in _head(columns, count).items():
        if {line.rstrip() for line in set(lines[place:-1:length])} != {text}:
            return False
    if not all(line.startswith(b"ITEM: BOX BOUNDS") for line in set(lines[4:-1:length])):
        return False
    return lines[1:-1:length] == [b"%d" % step for step in steps]


def _first_fault(path: Path, lines: list[bytes], columns: Sequence[str], count: int, steps: Sequence[int]) -> str:
    """Where and how the dump departs from what was ordered."""
    length = HEAD + count
    head = _head(columns, count)
    for index, line in enumerate(lines[:-1]):
        frame, place = divmod(index, length)
        text = line.decode(errors="replace").strip()
        where = f"{path}:{index + 1}"
        if frame >= len(steps):
            return f"{where}: more than the {len(steps)} frames that were ordered"
        if place in head and line.rstrip() != head[place]:
            return f"{where}: {text!r} in place of {head[place].decode()!r}"
        if place == 1 and text != str(steps[frame]):
            return f"{where}: step {text!r} in place of {steps[frame]}"
        if place == 4 and not text.startswith("ITEM: BOX BOUNDS"):
            return f"{where}: {text!r} in place of 'ITEM: BOX BOUNDS'"
        if place >= HEAD and number_rows([line], len(columns)) is None:
            return f"{where}: not {len(columns)} finite numbers: {text!r}"
    found = (len(lines) - 1) // length
    return f"{path}:{len(lines)}: the file ends after {found} of {len(steps)} frames"


def read_run(
    folder: Path,
    scene: Scene,
    types: Sequence[int],
    walls: Sequence[Wall],
    pairs: Callable[[Path, Scene], Rows],
) -> Columns:
    """Columns of a run record from the dumps of a deck in `folder`; `pairs` reads the contacts between particles.

    `types` are the atom types as typed, `walls` tell which columns hold the force of which body on each particle [N].
    The codes add the weight to the force they dump; it is taken off again here, which leaves in the contact force a
    rounding error of one unit in the last place of the larger of the two (exactly zero in free flight along an axis).
    """
    steps = range(0, scene.steps + 1, scene.output_every)
    _check_particles(folder / PARTICLES, scene, types)
    names = ("id", *STATE, *(column for wall in walls for column in wall[1]))
    frames = read_frames(folder / HISTORY, names, len(scene.particles), steps)
    _check_ids(folder / HISTORY, frames)
    mass = np.array([particle.mass for particle in scene.particles])
    columns: Columns = {
        "position": frames[:, :, 1:4],
        "velocity": frames[:, :, 4:7],
        "angular_velocity": frames[:, :, 7:10],
        "force": frames[:, :, 10:13] - mass[None, :, None] * gravities(scene),
        "torque": frames[:, :, 13:16],
    }
    if walls:
        body_force = np.zeros((len(frames), len(scene.bodies), 3))
        for place, (body, _) in enumerate(walls):
            body_force[:, body] -= frames[:, :, 16 + 3 * place : 19 + 3 * place].sum(axis=1)
        columns["body_force"] = body_force
    if scene.contacts:
        found = [pairs(folder / CONTACTS, scene), *wall_contacts(frames[:, :, 16:], walls, len(scene.particles))]
        columns |= contact_columns(folder / CONTACTS, len(frames), found)
    return columns


def wall_contacts(columns: Array, walls: Sequence[Wall], count: int) -> list[Rows]:
    """Contacts with bodies from the forces of walls on each particle, shape (T, N, 3 walls) [N].

    A force of exactly zero is no contact.
    """
    found: list[Rows] = []
    for place, (body, _) in enumerate(walls):
        force = columns[:, :, 3 * place : 3 * place + 3]
        sample, particle = np.nonzero(np.any(force != 0.0, axis=2))
        pair = np.stack([particle, np.full_like(particle, count + body)], axis=1)
        found.append(Rows(sample, pair, force[sample, particle]))
    return found


def read_entries(path: Path, columns: Sequence[str], steps: Sequence[int]) -> tuple[NDArray[np.int64], Array]:
    """Sample index of every row of a `dump local`, shape (M,), and its numbers, shape (M, C). Raises RunFailed."""
    try:
        lines = path.read_bytes().split(b"\n")
    except FileNotFoundError:
        raise RunFailed(f"{path}: the run wrote no such file") from None
    head = b"ITEM: ENTRIES " + " ".join(columns).encode()
    rows: list[bytes] = []
    counts: list[int] = []
    at = 0
    for step in steps:
        frame = [line.rstrip() for line in lines[at : at + HEAD]]
        wanted = {0: b"ITEM: TIMESTEP", 1: b"%d" % step, 2: b"ITEM: NUMBER OF ENTRIES", 8: head}
        for place, text in wanted.items():
            if len(frame) < HEAD or frame[place] != text:
                found = frame[place].decode(errors="replace") if place < len(frame) else "the end of the file"
                raise RunFailed(f"{path}:{at + place + 1}: {found!r} in place of {text.decode()!r}")
        if not frame[3].isdigit():
            raise RunFailed(f"{path}:{at + 4}: {frame[3].decode(errors='replace')!r} in place of a number of entries")
        counts.append(int(frame[3]))
        rows += lines[at + HEAD : at + HEAD + counts[-1]]
        at += HEAD + counts[-1]
    if lines[at:] != [b""]:
        raise RunFailed(f"{path}:{at + 1}: more or fewer lines than the {len(steps)} frames that were ordered")
    values = number_rows(rows, len(columns))
    if values is None:
        bad = next(line for line in rows if number_rows([line], len(columns)) is None)
        raise RunFailed(f"{path}: not {len(columns)} finite numbers: {bad.decode(errors='replace')!r}")
    return np.repeat(np.arange(len(counts)), counts), values


def _check_ids(path: Path, frames: Array) -> None:
    ids = np.arange(1.0, frames.shape[1] + 1.0)
    if not np.array_equal(frames[:, :, 0], np.broadcast_to(ids, frames.shape[:2])):
        raise RunFailed(f"{path}: particles are missing, doubled or out of order")


def _check_particles(path: Path, scene: Scene, types: Sequence[int]) -> None:
    """Raises RunFailed unless the code holds the particles of the scene: type, mass [kg] and radius [m] of each."""
    frames = read_frames(path, ("id", "type", "mass", "radius"), len(scene.particles), (0, scene.steps))
    _check_ids(path, frames)
    wanted = np.array([(kind, p.mass, p.radius) for kind, p in zip(types, scene.particles, strict=True)])
    wrong = np.argwhere(np.abs(frames[:, :, 1:] - wanted) > 1e-15 * wanted)
    if len(wrong):
        frame, row, column = (int(value) for value in wrong[0])
        raise RunFailed(
            f"{path}:{frame * (HEAD + len(wanted)) + HEAD + row + 1}: {('type', 'mass', 'radius')[column]} "
            f"{frames[frame, row, column + 1]:.17g} in place of {wanted[row, column]:.17g}"
        )
