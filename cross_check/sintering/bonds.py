"""Bonds that survive a test, and the fragments that contacts or bonds hold together."""

# pyright: reportUnknownVariableType=false, reportUnknownArgumentType=false, reportUnknownMemberType=false
# scipy leaves its graphs untyped.

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from cross_check.sintering.outcome import Numbers
from cross_check.sintering.snapshot import Indices, Snapshot

# A bond survives as long as its largest overlap is at least so much of what it was before the test.
KEPT = 0.5


def fragments(count: int, pairs: Indices) -> Indices:
    """Sizes of the sets of `count` particles that `pairs` (M, 2) hold together, the largest first."""
    ones = np.ones(len(pairs), dtype=np.int8)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    _, label = connected_components(graph, directed=False)
    return np.sort(np.bincount(label))[::-1]


def fragment_numbers(state: Snapshot) -> Numbers:
    """The largest fragment and the particles without a neighbour over all particles [-], and how many fragments."""
    sizes = fragments(state.count, state.pair[state.between_particles])
    return {
        "largest_share": float(sizes[0] / state.count),
        "single_share": float(np.sum(sizes == 1) / state.count),
        "fragments": float(np.sum(sizes > 1)),
    }


def surviving(before: Snapshot, after: Snapshot) -> Indices:
    """Pairs (M, 2) of the bonds of `before` that still hold: same pair, largest overlap not below half of its own."""
    now = _largest_overlaps(after)
    kept = [pair for pair, largest in _largest_overlaps(before).items() if now.get(pair, 0.0) >= KEPT * largest]
    return np.array(kept, dtype=np.int64).reshape(-1, 2)


def bond_numbers(before: Snapshot, after: Snapshot) -> Numbers:
    """Share of the bonds that survive [-], clusters of them, the largest one and single particles as shares [-]."""
    kept = surviving(before, after)
    total = int(np.sum(before.between_particles))
    sizes = fragments(before.count, kept)
    return {
        "bonds_surviving": len(kept) / total if total else np.nan,
        "bond_clusters": float(np.sum(sizes > 1)),
        "bond_largest_share": float(sizes[0] / before.count),
        "bond_single_share": float(np.sum(sizes == 1) / before.count),
    }


def _largest_overlaps(state: Snapshot) -> dict[tuple[int, int], float]:
    """Largest overlap of every pair of particles [m]."""
    both = state.between_particles
    pairs = np.sort(state.pair[both], axis=1)
    return {(int(i), int(j)): float(d) for (i, j), d in zip(pairs, state.largest_overlap[both], strict=True)}
