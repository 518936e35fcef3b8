"""Baselines: what the ensembles of every code gave at one date, as one small JSON file per case (docs/formats.md)."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from datetime import date
from pathlib import Path
from typing import Any

from cross_check.ensembles import Ensemble
from cross_check.record import Code
from cross_check.reference import FOLDER, slug

SCHEMA = 1


class BaselineError(Exception):
    """A baseline that cannot be made, read or compared: the message names the file and what is allowed."""


@dataclass(frozen=True)
class Measure:
    """A scalar of a run: the mean of an observable over the last share `average` of the samples of a stage."""

    observable: str
    stage: str
    average: float
    unit: str

    @property
    def name(self) -> str:
        """The measure in words."""
        return f"{self.observable}, {self.stage}, last {100.0 * self.average:g} %"


@dataclass(frozen=True)
class Member:
    """One run of an ensemble: `digest` is that of its measured record, `values` has one number per measure."""

    seed: int
    deck_hash: str
    digest: str
    machine: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class Entry:
    """The recorded ensemble of one source of one variant; `members` in the order of their seeds."""

    variant: str
    source: str
    code: Code
    members: tuple[Member, ...]


@dataclass(frozen=True)
class Baseline:
    """The ensembles of one case at one `date` (ISO), recorded by one `version` of Crossgrain.

    Every member has the values of all `measures`, in this order.
    """

    case: str
    date: str
    version: str
    measures: tuple[Measure, ...]
    entries: tuple[Entry, ...]

    @property
    def name(self) -> str:
        """Date and version, for messages and axes."""
        return f"{self.date} ({self.version})"


def capture(
    ensembles: Sequence[Ensemble], measures: Sequence[tuple[str, str, float]], when: str, version: str
) -> Baseline:
    """The baseline of the ensembles of one case; a measure is (observable, stage, average).

    Raises BaselineError for ensembles of several cases, none, or two of the same source and variant, and RecordError
    for an observable or a stage that an ensemble does not have.
    """
    cases = sorted({ensemble.case for ensemble in ensembles})
    if len(cases) != 1:
        raise BaselineError(f"a baseline is of one case, the ensembles are of: {', '.join(cases) or 'none'}")
    chosen = [Measure(name, stage, average, ensembles[0].unit(name)) for name, stage, average in measures]
    entries = sorted(
        (_entry(ensemble, chosen) for ensemble in ensembles), key=lambda entry: (entry.variant, entry.source)
    )
    baseline = Baseline(cases[0], when, version, tuple(chosen), tuple(entries))
    check(baseline, f"baseline of {cases[0]}")
    return baseline


def _entry(ensemble: Ensemble, measures: Sequence[Measure]) -> Entry:
    for measure in measures:
        if ensemble.unit(measure.observable) != measure.unit:
            raise BaselineError(
                f"{ensemble.source} of {ensemble.case}/{ensemble.variant}: {measure.observable} is in "
                f"{ensemble.unit(measure.observable)}, expected {measure.unit}"
            )
    columns = [ensemble.values(measure.observable, measure.stage, measure.average) for measure in measures]
    members = [
        Member(
            seed,
            record.header.deck_hash,
            record.digest(),
            record.header.machine,
            tuple(float(column[place]) for column in columns),
        )
        for place, (seed, record) in enumerate(zip(ensemble.seeds, ensemble.members, strict=True))
    ]
    return Entry(ensemble.variant, ensemble.source, ensemble.code, tuple(members))


def check(baseline: Baseline, where: str) -> None:
    """Raises BaselineError unless every member has a finite value of every measure and nothing stands twice."""
    try:
        date.fromisoformat(baseline.date)
    except ValueError:
        raise BaselineError(f"{where}: date {baseline.date!r}, expected an ISO date such as 2026-03-01") from None
    names = [measure.name for measure in baseline.measures]
    if not names or len(set(names)) != len(names):
        raise BaselineError(f"{where}: measures must be there and differ: {'; '.join(names) or 'none'}")
    seen: set[tuple[str, str]] = set()
    for entry in baseline.entries:
        place = f"{where}: {entry.source} of {entry.variant}"
        if (entry.variant, entry.source) in seen:
            raise BaselineError(f"{place} stands twice")
        seen.add((entry.variant, entry.source))
        seeds = [member.seed for member in entry.members]
        if not seeds or seeds != sorted(set(seeds)):
            raise BaselineError(f"{place} has the seeds {seeds}, expected some, each once and in order")
        for member in entry.members:
            if len(member.values) != len(names):
                raise BaselineError(
                    f"{place}, seed {member.seed}: {len(member.values)} values for {len(names)} measures"
                )
            for name, value in zip(names, member.values, strict=True):
                if not math.isfinite(value):
                    raise BaselineError(f"{place}, seed {member.seed}: {name} is {value}, expected a finite number")


def folder(case: str) -> Path:
    """Where the baselines of a case lie."""
    return FOLDER / "baselines" / slug(case)


def path_of(baseline: Baseline) -> Path:
    """Where a baseline belongs: one file for each date and version."""
    return folder(baseline.case) / f"{baseline.date}_{slug(baseline.version)}.json"


def write(baseline: Baseline, path: Path) -> None:
    """Checks a baseline and writes it, one member a line, so that a change is a diff to review."""
    check(baseline, str(path))
    entries = [
        f'  {{"variant": {json.dumps(entry.variant)}, "source": {json.dumps(entry.source)}, '
        f'"code": {json.dumps(asdict(entry.code))}, "members": [\n'
        + ",\n".join(f"   {json.dumps(asdict(member))}" for member in entry.members)
        + "\n  ]}"
        for entry in baseline.entries
    ]
    measures = ",\n".join(f"  {json.dumps(asdict(measure))}" for measure in baseline.measures)
    heads = {"schema": SCHEMA, "case": baseline.case, "date": baseline.date, "version": baseline.version}
    lines = [f' "{key}": {json.dumps(value)}' for key, value in heads.items()]
    lines += [f' "measures": [\n{measures}\n ]', ' "entries": [\n' + ",\n".join(entries) + "\n ]"]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


def read(path: Path) -> Baseline:
    """Reads and checks a baseline. Raises BaselineError with the file and the reason."""
    try:
        raw: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        schema = raw.pop("schema", None)
        if schema != SCHEMA:
            raise BaselineError(f"{path}: schema {schema!r}, this version reads schema {SCHEMA}")
        raw["measures"] = tuple(Measure(**measure) for measure in raw["measures"])
        raw["entries"] = tuple(_from_json(entry) for entry in raw["entries"])
        baseline = Baseline(**raw)
    except OSError as error:
        raise BaselineError(f"{path}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise BaselineError(f"{path}: not a readable baseline ({error!r})") from error
    check(baseline, str(path))
    return baseline


def _from_json(raw: dict[str, Any]) -> Entry:
    members: list[Member] = []
    for member in raw["members"]:
        member["values"] = tuple(float(value) for value in member["values"])
        members.append(Member(**member))
    raw["code"], raw["members"] = Code(**raw["code"]), tuple(members)
    return Entry(**raw)


def recorded(case: str) -> list[Baseline]:
    """All recorded baselines of a case, the oldest first."""
    found = [read(path) for path in folder(case).glob("*.json")]
    return sorted(found, key=lambda baseline: (baseline.date, baseline.version))
