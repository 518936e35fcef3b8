"""Contacts as run records hold them, from the rows that a code wrote."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cross_check.adapters.interface import RunFailed
from cross_check.adapters.runner import Columns
from cross_check.record import Array
from cross_check.scene import Scene


@dataclass(frozen=True)
class Rows:
    """Contacts in any order: index of the sample, shape (M,), both sides, shape (M, 2), force on the first, (M, 3) [N].

    Sides are indices of particles; a body follows the particles.
    """

    sample: NDArray[np.int64]
    pair: NDArray[np.int64]
    force: Array


def pair_rows(path: Path, scene: Scene, sample: NDArray[np.int64], ids: Array, force: Array) -> Rows:
    """Contacts between particles that a code counts from 1. Raises RunFailed for an id that is none."""
    pair = ids.astype(np.int64)
    if np.any(pair != ids) or np.any((pair < 1) | (pair > len(scene.particles))):
        bad = ids[np.any((pair != ids) | (pair < 1) | (pair > len(scene.particles)), axis=1)][0]
        raise RunFailed(f"{path}: {bad[0]:g} {bad[1]:g} are no ids of the {len(scene.particles)} particles")
    return Rows(sample, pair - 1, force)


def contact_columns(path: Path, samples: int, parts: Sequence[Rows]) -> Columns:
    """The contact columns of a record: by sample, then by pair, forces on the side of the lower index."""
    sample = np.concatenate([part.sample for part in parts])
    pair = np.concatenate([part.pair for part in parts])
    force = np.concatenate([part.force for part in parts])
    swapped = pair[:, 0] > pair[:, 1]
    pair = np.where(swapped[:, None], pair[:, ::-1], pair)
    force = np.where(swapped[:, None], -force, force)
    order = np.lexsort((pair[:, 1], pair[:, 0], sample))
    sample, pair, force = sample[order], pair[order], force[order]
    same = (np.diff(sample) == 0) & np.all(np.diff(pair, axis=0) == 0, axis=1)
    if np.any(same):
        at = int(np.flatnonzero(same)[0])
        raise RunFailed(f"{path}: contact {pair[at, 0]}-{pair[at, 1]} stands twice in sample {sample[at]}")
    start = np.searchsorted(sample, np.arange(samples + 1)).astype(np.int64)
    return {"contact_start": start, "contact_pair": pair.astype(np.int64), "contact_force": force}
