"""Ensembles: the measured records of one source of one variant for every seed of a case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cross_check.measured import Measured
from cross_check.record import Array, Code, RecordError


@dataclass(frozen=True)
class Ensemble:
    """Measured records in the order of their seeds, all of one case, variant, source, code and version."""

    case: str
    variant: str
    source: str
    code: Code
    members: tuple[Measured, ...]

    @property
    def seeds(self) -> tuple[int, ...]:
        """The seeds, in increasing order."""
        return tuple(seed for member in self.members if (seed := member.header.seed) is not None)

    def values(self, observable: str, stage: str, average: float) -> Array:
        """A scalar observable of every seed, shape (n,): means over the last share of the samples of a stage."""
        return np.array([member.value(observable, stage, average) for member in self.members])

    def curves(self, observable: str, stage: str) -> list[tuple[Array, Array]]:
        """Times (S,) [s] since the first sample of the stage and values (S,) of every seed, for `aligned`."""
        found: list[tuple[Array, Array]] = []
        for member in self.members:
            time, values = member.curve(observable, stage)
            if values.ndim != 1:
                raise RecordError(f"{member.name}: {observable} has {values.shape[1]} components, expected a scalar")
            found.append((time - time[0], values))
        return found

    def unit(self, observable: str) -> str:
        """The unit of an observable."""
        first = self.members[0]
        first[observable]  # pyright: ignore[reportUnusedExpression]  # raises where there is none
        return first.units[observable]


def ensemble(records: Sequence[Measured], seeds: Sequence[int]) -> Ensemble:
    """Puts records together. Raises RecordError unless there is exactly one record for each seed and all are alike."""
    if not records:
        raise RecordError("an ensemble needs at least one record")
    first = records[0].header
    kind = (first.case, first.variant, first.source, first.refinement, first.code)
    found: dict[int, Measured] = {}
    for record in records:
        header = record.header
        other = (header.case, header.variant, header.source, header.refinement, header.code)
        if other != kind:
            raise RecordError(f"an ensemble of different runs: {_words(kind)} and {_words(other)}")
        if record.units != records[0].units or record.stages != records[0].stages:
            raise RecordError(f"{record.name}: its observables or stages are not those of {records[0].name}")
        if header.seed is None:
            raise RecordError(f"{record.name}: the record has no seed")
        if header.seed in found:
            raise RecordError(f"{record.name}: two records have this seed")
        found[header.seed] = record
    missing, extra = sorted(set(seeds) - set(found)), sorted(set(found) - set(seeds))
    name = f"{first.source} of {first.case}/{first.variant}"
    if missing:
        raise RecordError(f"{name}: no record for the seeds {_list(missing)} (there: {_list(sorted(found))})")
    if extra:
        raise RecordError(f"{name}: records for the seeds {_list(extra)}, which the case does not have")
    members = tuple(found[seed] for seed in sorted(found))
    return Ensemble(first.case, first.variant, first.source, first.code, members)


def same_seeds(left: Ensemble, right: Ensemble) -> None:
    """Raises RecordError where two ensembles of a case were made from different seeds or belong to different cases."""
    if (left.case, left.variant) != (right.case, right.variant):
        raise RecordError(f"ensembles of {left.case}/{left.variant} and of {right.case}/{right.variant}")
    if left.seeds != right.seeds:
        raise RecordError(
            f"{left.case}/{left.variant}: {left.source} has the seeds {_list(left.seeds)}, "
            f"{right.source} has {_list(right.seeds)}"
        )


def _words(kind: tuple[str, str, str, int, Code]) -> str:
    case, variant, source, refinement, code = kind
    return f"{source} ({code.name} {code.version}) of {case}/{variant}, refinement {refinement}"


def _list(seeds: Sequence[int]) -> str:
    return ", ".join(str(seed) for seed in seeds)
