"""A campaign: the runs of some cases, kept in a folder, compared and reported."""

from __future__ import annotations

import json
import os
import platform
import shutil
import statistics
import sys
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from cross_check import engine, measured, regression, report, runs
from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import Deck
from cross_check.bed_plots import bed_curves, bed_seeds
from cross_check.cache import Cache
from cross_check.compare.checks import compare
from cross_check.compare.differences import known
from cross_check.compare.ensemble_checks import ENSEMBLE_CHECKS, beds, compare_ensembles
from cross_check.compare.expectations import expect, rules
from cross_check.compare.outcome import Outcome
from cross_check.compare.verdicts import FULL_ONLY, Comparison
from cross_check.curves import curves, drawn, sweeps
from cross_check.engine import Case, CaseError, case_file, load_case
from cross_check.histories import histories
from cross_check.record import RecordError, read
from cross_check.report.campaign import Campaign, CaseInfo, CurveSet, SourceRun, SweepPlot
from cross_check.scene import Scene

INDEX = "campaign.json"
SCHEMA = 1


@dataclass(frozen=True)
class Finished:
    """Cases with their outcomes, and when and how they ran."""

    suite: str
    cases: list[Case]
    results: runs.Results
    codes: tuple[str, ...]
    started: str
    duration: float


def run(suite: str, cases: list[Case], options: runs.Options, work: Path, progress: runs.Progress) -> Finished:
    """Runs the cases. Raises CaseError."""
    started, clock = datetime.now(timezone.utc).isoformat(timespec="seconds"), time.monotonic()
    results = runs.execute(cases, options, Cache(), work, progress)
    return Finished(suite, cases, results, options.codes, started, time.monotonic() - clock)


def comparisons(finished: Finished, expected: Path | None = None) -> list[Comparison]:
    """All comparisons of all gates, with the verdicts that `expected` (or the package's table) expects."""
    found: list[Comparison] = []
    for case in finished.cases:
        for variant in case.variants:
            outcomes = finished.results[variant.scenes[0].name]
            for gate in variant.gates:
                if gate.check not in ENSEMBLE_CHECKS:
                    found += compare(variant.scenes[0], gate, outcomes, finished.codes)
        for bed in beds(case, finished.results, finished.codes):
            found += compare_ensembles(bed)
    complete = finished.codes == tuple(ADAPTERS)
    table = rules() if expected is None else rules(expected)
    return expect(found, table, {case.name for case in finished.cases}, complete)


def write(
    finished: Finished, folder: Path, expected: Path | None = None, pdf: bool = True, figures: bool = True
) -> tuple[Path, list[Comparison]]:
    """Writes verdicts, JUnit and the report into `folder`; returns the page and the comparisons.

    Drawing takes most of the time: with `pdf` false the figures are SVG only, with `figures` false there are none.
    """
    verdicts = comparisons(finished, expected)
    outcomes = [outcome for group in finished.results.values() for outcome in group.values()]
    changed, over_time = regression.changes(finished.cases, finished.results, finished.codes)
    page = report.write(
        folder,
        Campaign(
            suite=finished.suite,
            started=finished.started,
            duration=finished.duration,
            comparisons=verdicts,
            cases=[_info(case) for case in finished.cases],
            runs=[
                _provenance(outcome)
                for outcome in outcomes
                if outcome.scene.refinement == 0 and outcome.verdict != FULL_ONLY
            ],
            translations={
                f"{outcome.scene.name}|{outcome.source}": (deck.files[deck.main], deck.translation)
                for outcome in outcomes
                if (deck := outcome.deck) is not None
            },
            curves=_curves(finished) if figures else [],
            sweeps=_sweeps(finished) if figures else [],
            environment=environment(),
            changes=changed,
            trends=over_time if figures else [],
            left_out=_left_out(finished),
            known_differences={name: str(entry["explanation"]).strip() for name, entry in known().items()},
        ),
        pdf,
    )
    return page, verdicts


def _curves(finished: Finished) -> list[CurveSet]:
    """The curves of every scene that is drawn, then those of beds."""
    scenes = [
        item
        for case in finished.cases
        for name in drawn(case, finished.results)
        for item in _figures(case, name, finished)
    ]
    return scenes + [item for case in finished.cases for item in bed_curves(case, finished.results, finished.codes)]


def _sweeps(finished: Finished) -> list[SweepPlot]:
    """The plots over an axis of a case, and over the seeds of its beds."""
    return [
        plot
        for case in finished.cases
        for draw in (sweeps, bed_seeds)
        for plot in draw(case, finished.results, finished.codes)
    ]


def _figures(case: Case, name: str, finished: Finished) -> list[CurveSet]:
    """The curves of a scene: those of an impact, or the course of what the case compares."""
    outcomes = finished.results[name]
    impact = list(curves(name, outcomes, finished.codes))
    return impact or list(histories(case, name, outcomes, finished.codes))


def _left_out(finished: Finished) -> list[str]:
    """What the quick form leaves to the full one, case by case."""
    lines: list[str] = []
    for case in finished.cases:
        names = [variant.scenes[0].name for variant in case.variants]
        count = sum(any(item.verdict == FULL_ONLY for item in finished.results[name].values()) for name in names)
        if count:
            lines.append(f"{case.name}: {count} of {len(names)} variants, which run with --full")
    return lines


def _info(case: Case) -> CaseInfo:
    observables = list(dict.fromkeys(gate.quantity for gate in case.gates))
    return CaseInfo(case.name, case.question, case.level, case.source, observables)


def _provenance(outcome: Outcome) -> SourceRun:
    scene, header = outcome.scene, outcome.header
    if header is None:
        return SourceRun(
            scene.name, outcome.source, "", "", "", outcome.origin, outcome.deck.hash if outcome.deck else "", "", 0.0,
            scene.steps, scene.time_step, outcome.verdict,
        )  # fmt: skip
    return SourceRun(
        scene.name, outcome.source, header.code.name, header.code.version, header.code.package, outcome.origin,
        header.deck_hash, header.machine, header.wall_time, header.steps, header.time_step, outcome.note,
    )  # fmt: skip


def environment() -> list[tuple[str, str]]:
    """Which programs and which machine: name and version."""
    found = [("machine", f"{platform.system()} {platform.machine()}"), ("python", sys.version.split()[0])]
    found.append(("native engine", f"{engine.version()} (build {engine.build()[:12]})"))
    for name, adapter in ADAPTERS.items():
        code = adapter.installed()
        found.append((name, "not installed" if code is None else f"{code.version} ({code.package})"))
    return found


def keep(finished: Finished, folder: Path) -> None:
    """Keeps records, decks and an index in `folder`, so that `compare` and `report` need nothing else."""
    entries: list[dict[str, object]] = []
    for name, outcomes in finished.results.items():
        for (source, refinement), outcome in outcomes.items():
            place = Path("runs") / name / f"{source}-{refinement}"
            if outcome.folder is not None:
                _link(outcome.folder, folder / place)
            if outcome.deck is not None:
                write_deck(outcome.deck, folder / place)
            entries.append(
                {
                    "scene": name,
                    "source": source,
                    "refinement": refinement,
                    "folder": str(place) if outcome.header is not None else None,
                    "verdict": outcome.verdict,
                    "origin": outcome.origin,
                }
            )
    index = {
        "schema": SCHEMA,
        "suite": finished.suite,
        "cases": [str(_copy(case, folder)) for case in finished.cases],
        "codes": finished.codes,
        "started": finished.started,
        "duration": finished.duration,
        "outcomes": entries,
    }
    (folder / INDEX).write_text(json.dumps(index, indent=1) + "\n")


def _copy(case: Case, folder: Path) -> Path:
    """Copies a case file into the folder, so that the folder can be moved; returns its place in there.

    The cases that it starts from stand beside it under the names by which the engine finds them.
    """
    place = Path("cases") / case_file(case.name)
    (folder / place).parent.mkdir(parents=True, exist_ok=True)
    start = case.variants[0].scenes[0].start
    sources = {place: case.path}
    while start is not None:
        name = case_file(start.scene.case)
        sources[Path("cases") / name] = case.path.parent / name
        start = start.scene.start
    for target, source in sources.items():
        if not (folder / target).exists() or not source.samefile(folder / target):
            shutil.copyfile(source, folder / target)
    return place


def _link(source: Path, target: Path) -> None:
    """Puts the files of a record into another folder, without a second copy where the file system allows that."""
    target.mkdir(parents=True, exist_ok=True)
    for path in source.iterdir():
        place = target / path.name
        place.unlink(missing_ok=True)
        try:
            os.link(path, place)
        except OSError:
            shutil.copy2(path, place)


def load(folder: Path) -> Finished:
    """The campaign that was kept in `folder`. Raises CaseError or RecordError."""
    path = folder / INDEX
    try:
        index = json.loads(path.read_text())
        found = index["schema"]
        if found != SCHEMA:
            raise RecordError(f"{path}: schema {found!r}, this version reads schema {SCHEMA}")
        return _finished(index, folder)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RecordError(f"{path}: not a kept campaign ({error!r})") from error


def _finished(index: dict[str, Any], folder: Path) -> Finished:
    """The campaign of an index; an index without the keys that `keep` writes raises KeyError or TypeError."""
    path = folder / INDEX
    cases = [load_case(folder / case) for case in index["cases"]]
    scenes = {
        (variant.scenes[0].name, scene.refinement): scene
        for case in cases
        for variant in case.variants
        for scene in variant.scenes
    }
    results: runs.Results = {variant.scenes[0].name: {} for case in cases for variant in case.variants}
    for entry in index["outcomes"]:
        name, source, refinement = entry["scene"], entry["source"], int(entry["refinement"])
        scene = scenes.get((name, refinement))
        if scene is None:
            raise CaseError(f"{path}: the case no longer has the scene {name} (refinement {refinement})")
        results[name][source, refinement] = _reload(entry, source, scene, folder)
    return Finished(index["suite"], cases, results, tuple(index["codes"]), index["started"], float(index["duration"]))


def _reload(entry: dict[str, str | None], source: str, scene: Scene, folder: Path) -> Outcome:
    adapter = ADAPTERS.get(source)
    deck = adapter.deck(scene) if adapter is not None and entry["folder"] is not None else None
    for code, other in ADAPTERS.items():
        if source == f"native[{code}]" and entry["folder"] is not None:
            scene = other.mirror(scene)
    place = None if entry["folder"] is None else folder / entry["folder"]
    outcome = Outcome(source, scene, None, entry["verdict"] or "", entry["origin"] or "", deck, place)
    if place is None:
        return outcome
    if (place / measured.FILE).is_file():
        return replace(outcome, measured=measured.read(place))
    return replace(outcome, record=runs.labelled(read(place), source))


def write_deck(deck: Deck, folder: Path) -> None:
    """Writes the files of a deck and `translation.json` into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in deck.files.items():
        (folder / name).write_text(text)
    rows = [asdict(row) for row in deck.translation]
    sheet = {"code": deck.code, "scene": deck.scene.name, "hash": deck.hash, "main": deck.main, "rows": rows}
    (folder / "translation.json").write_text(json.dumps(sheet, indent=1) + "\n")


def rates(finished: Finished) -> list[str]:
    """Time of every source per particle and step of the beds that ran, median over their runs, one line a source.

    The times are wall times of runs beside each other, of this and of earlier campaigns.
    """
    found: dict[str, list[float]] = {}
    for outcomes in finished.results.values():
        for (source, _), outcome in outcomes.items():
            if outcome.measured is not None and (header := outcome.measured.header).steps > 0:
                found.setdefault(source, []).append(header.wall_time / (header.steps * len(header.mass)))
    return [f"{source}: {1e6 * statistics.median(times):.2f} us per particle-step" for source, times in found.items()]


def unexpected(verdicts: Iterable[Comparison]) -> list[Comparison]:
    """The comparisons whose verdict is not the expected one."""
    return [item for item in verdicts if not item.as_expected]
