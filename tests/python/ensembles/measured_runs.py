"""Measured records of small synthetic ensembles, for the tests of measured records and baselines."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cross_check.ensembles import Ensemble, ensemble
from cross_check.measured import Measured
from cross_check.record import Array, Code, Header

SEEDS = (1, 2, 3, 4, 5)
UNITS = {"packing_fraction": "-", "coordination": "-", "wall_force": "N"}
VERSIONS = {"native": "0.1.0", "yade": "2022.01a", "liggghts": "3.8.0"}


def run(source: str = "native", seed: int | None = 1, shift: float = 0.0, draw: int = 0, version: str = "") -> Measured:
    """A bed that is poured and relaxes: 100 samples in two stages; `shift` moves the packing fraction."""
    generator = np.random.default_rng([SEEDS.index(seed) if seed in SEEDS else 99, draw, len(source)])
    time: Array = np.arange(100.0) * 1e-2
    scatter = 0.004 * generator.normal() + shift
    series: dict[str, Array] = {
        "packing_fraction": 0.6 * (1.0 - np.exp(-time / 0.1)) + scatter,
        "coordination": 4.0 + np.zeros(100) + 0.05 * generator.normal(),
        "wall_force": np.column_stack([np.sin(time), np.cos(time), time]),
    }
    name = source.partition("[")[0]
    code = Code(name, version or VERSIONS[name], f"{name} package")
    header = Header(
        source, "poured-bed", "friction=0.5", seed, 0, code, f"deck-{source}-{seed}", "x86_64, 2 cpus", 1.5, 1e-5, 1000,
        "synchronized", "exact", [2e-6] * 500, [1e-3] * 500, ["floor"], [0.0, 0.0, -9.81],
    )  # fmt: skip
    stage = np.repeat([0, 1], [40, 60])
    return Measured(header, time, stage, ("pour", "relax"), series, dict(UNITS))


def bed(source: str = "native", shift: float = 0.0, draw: int = 0, version: str = "") -> Ensemble:
    """The ensemble of one source over all seeds."""
    return ensemble([run(source, seed, shift, draw, version) for seed in SEEDS], SEEDS)


def with_header(record: Measured, **changes: object) -> Measured:
    """The record with other values in its header."""
    return replace(record, header=replace(record.header, **changes))
