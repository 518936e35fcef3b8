"""Runs: every source of every scene of a campaign, from the cache, live, or recorded."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path

from cross_check import engine, reference
from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import Adapter, Deck, InvalidScene, NotComparable, RunFailed
from cross_check.cache import Cache, code_key, measured_key, native_key
from cross_check.compare.ensemble_checks import ENSEMBLE_CHECKS
from cross_check.compare.outcome import NATIVE, Outcome, Outcomes, mirror_name
from cross_check.compare.verdicts import FULL_ONLY, not_comparable, not_run
from cross_check.engine import Case, CaseError, Variant
from cross_check.measured import Measured
from cross_check.measured import read as read_measured
from cross_check.measuring import measure
from cross_check.record import Code, RecordError, RunRecord, read
from cross_check.scene import Scene

Progress = Callable[[str, int], None]
"""Told the name of a source and how many more of its runs are done."""


# Time per particle and step [s] after which a run hangs: ten times that of the slowest code.
SLOWEST = 1e-4


@dataclass(frozen=True)
class Options:
    """How runs are made.

    `full`: variants that the quick form leaves out run too. `live`: neither the cache nor recorded runs are used.
    `recorded`: recorded runs may stand in for live ones. `any_version`: codes of versions that are not proved run, too.
    `time_limit` [s] holds for each deck; beds have a longer one where their size asks for it.
    """

    codes: tuple[str, ...] = tuple(ADAPTERS)
    live: bool = False
    full: bool = False
    recorded: bool = True
    any_version: bool = False
    jobs: int = field(default_factory=lambda: os.cpu_count() or 1)
    time_limit: float = 300.0


@dataclass(frozen=True)
class _Job:
    variant: str
    source: str
    scene: Scene
    deck: Deck | None = None
    # A bed of an ensemble: its observables are kept, its trajectories are not.
    bed: bool = False
    # Whether a recorded run may stand in for a live one: all seeds of a bed but the first.
    substitute: bool = False


Results = dict[str, Outcomes]
"""Outcomes of every variant, by `case/variant`."""


def count(cases: list[Case], options: Options) -> int:
    """Number of runs that `execute` will report."""
    chosen = [(case, variant) for case in cases for variant in case.variants if options.full or not variant.full_only]
    native = sum(len(refined(case, variant)) for case, variant in chosen)
    mirrors = sum((0 if is_bed(variant) else len(mirrored(case, variant))) + 1 for case, variant in chosen)
    return native + mirrors * len(options.codes)


def is_bed(variant: Variant) -> bool:
    """Whether a variant is judged as a member of an ensemble."""
    return any(gate.check in ENSEMBLE_CHECKS for gate in variant.gates)


def execute(cases: list[Case], options: Options, cache: Cache, work: Path, progress: Progress) -> Results:
    """Runs all sources of all scenes. Raises CaseError where a scene cannot be stated at all."""
    results: Results = {}
    native: list[_Job] = []
    external: dict[str, list[_Job]] = {code: [] for code in options.codes}
    for case in cases:
        for variant in case.variants:
            name = variant.scenes[0].name
            results[name] = {}
            if variant.full_only and not options.full:
                results[name] = _left_out(variant.scenes[0], options.codes)
                continue
            if is_bed(variant):
                first = next(other for other in case.variants if other.name == variant.name)
                job = _Job(name, NATIVE, variant.scenes[0], bed=True, substitute=variant is not first)
                native.append(job)
                for code in options.codes:
                    _plan_bed(ADAPTERS[code], job, results[name], external[code], progress)
                continue
            native += [_Job(name, NATIVE, scene) for scene in refined(case, variant)]
            for code in options.codes:
                _plan(ADAPTERS[code], mirrored(case, variant), results[name], native, external[code], progress)
    with ThreadPoolExecutor(options.jobs) as pool:

        def run(job: _Job) -> Outcome:
            return _native(job, options, cache, work)

        for job, outcome in zip(native, pool.map(run, native), strict=True):
            results[job.variant][job.source, job.scene.refinement] = outcome
            progress(job.source, 1)
    for code, jobs in external.items():
        for job, outcome in zip(jobs, _external(ADAPTERS[code], jobs, options, cache, work, progress), strict=True):
            results[job.variant][job.source, 0] = outcome
    return results


def refined(case: Case, variant: Variant) -> tuple[Scene, ...]:
    """The scenes of a variant that a gate looks at: refinements serve closed forms and convergence only."""
    wanted = any(gate.check in ("reference", "convergence", "finest", "extrapolated") for gate in case.gates)
    return variant.scenes if wanted else variant.scenes[:1]


def mirrored(case: Case, variant: Variant) -> tuple[Scene, ...]:
    """The scenes that mirrors run: half the step serves the uncertainty of a code beside a closed form."""
    wanted = any(gate.check == "reference" for gate in case.gates)
    return tuple(scene for scene in variant.scenes if scene.refinement <= (1 if wanted else 0))


def _left_out(scene: Scene, codes: tuple[str, ...]) -> Outcomes:
    """The outcomes of a variant that only the full form runs."""
    sources = (NATIVE, *codes, *(mirror_name(code) for code in codes))
    return {(source, 0): Outcome(source, scene, None, FULL_ONLY, "not run") for source in sources}


def _plan(
    adapter: Adapter,
    scenes: tuple[Scene, ...],
    outcomes: Outcomes,
    native: list[_Job],
    external: list[_Job],
    progress: Progress,
) -> None:
    """Adds the runs of one code and of its mirror, or the outcomes that say why there are none."""
    name, code, mirror = scenes[0].name, adapter.name, mirror_name(adapter.name)
    try:
        deck = adapter.deck(scenes[0])
    except InvalidScene as error:
        raise CaseError(f"{name}: {error}") from error
    except NotComparable as reason:
        verdict = not_comparable(str(reason))
        for source, missing in ((code, scenes[:1]), (mirror, scenes)):
            for scene in missing:
                outcomes[source, scene.refinement] = Outcome(source, scene, None, verdict, "not run")
                progress(source, 1)
        return
    external.append(_Job(name, code, scenes[0], deck))
    native += [_Job(name, mirror, adapter.mirror(scene)) for scene in scenes]


def _plan_bed(adapter: Adapter, job: _Job, outcomes: Outcomes, external: list[_Job], progress: Progress) -> None:
    """Adds the run of one code of a bed, or the outcome that says why there is none."""
    try:
        deck = adapter.deck(job.scene)
    except InvalidScene as error:
        raise CaseError(f"{job.variant}: {error}") from error
    except NotComparable as reason:
        outcome = Outcome(adapter.name, job.scene, None, not_comparable(str(reason)), "not run")
        outcomes[adapter.name, 0] = outcome
        progress(adapter.name, 1)
        return
    external.append(replace(job, source=adapter.name, deck=deck))


def _native(job: _Job, options: Options, cache: Cache, work: Path) -> Outcome:
    key = native_key(job.scene)
    if job.bed:
        kept = measured_key(key, job.scene)
        if not options.live and (stored := cache.measured(kept)) is not None:
            return _measured_outcome(job, stored, "cache", cache.folder(kept))
    if not options.live and (record := cache.get(key)) is not None:
        return Outcome(job.source, job.scene, labelled(record, job.source), origin="cache", folder=cache.folder(key))
    try:
        record = engine.run(job.scene, states=work / "states")
    except (CaseError, RecordError) as error:
        return Outcome(job.source, job.scene, None, not_run(str(error)), "not run")
    if job.bed:
        return _measured(job, record, measured_key(key, job.scene), cache)
    kept = cache.put(key, record)
    return Outcome(job.source, job.scene, labelled(record, job.source), folder=kept)


def _measured(job: _Job, record: RunRecord, key: str, cache: Cache) -> Outcome:
    """Measures a record and keeps what was measured."""
    try:
        found = measure(job.scene, record)
        folder = cache.put_measured(key, found)
    except (CaseError, RecordError) as error:
        return Outcome(job.source, job.scene, None, not_run(str(error)), "not run", job.deck)
    return _measured_outcome(job, found, "live", folder)


def _measured_outcome(job: _Job, found: Measured, origin: str, folder: Path) -> Outcome:
    return Outcome(job.source, job.scene, None, origin=origin, deck=job.deck, folder=folder, measured=found)


def labelled(record: RunRecord, source: str) -> RunRecord:
    """The record under another source's name: mirrors that run the same scene share one record."""
    return replace(record, header=replace(record.header, source=source))


def _external(
    adapter: Adapter, jobs: list[_Job], options: Options, cache: Cache, work: Path, progress: Progress
) -> list[Outcome]:
    """Outcomes of the decks of one code, in order."""
    code = adapter.installed()
    if code is not None and code.version not in adapter.proved_versions and not options.any_version:
        proved = ", ".join(adapter.proved_versions)
        reason = not_comparable(f"{code.name} {code.version} is installed, the translation is proved for {proved}")
        progress(adapter.name, len(jobs))
        return [Outcome(job.source, job.scene, None, reason, "not run", job.deck) for job in jobs]
    outcomes: dict[int, Outcome] = {}
    for index, job in enumerate(jobs):
        stored = _stored(job, code, options, cache)
        if stored is not None:
            outcomes[index] = stored
            progress(adapter.name, 1)
    waiting = [index for index in range(len(jobs)) if index not in outcomes]
    if code is None:
        reason = not_run(f"{adapter.name} is not installed and there is no recorded run of this deck")
        for index in waiting:
            outcomes[index] = Outcome(adapter.name, jobs[index].scene, None, reason, "not run", jobs[index].deck)
            progress(adapter.name, 1)
        waiting = []
    # Small decks share the start of a program; each bed is kept as soon as it is done, so that a stopped suite goes on.
    small = [index for index in waiting if not jobs[index].bed]
    shares = [small[first :: options.jobs] for first in range(options.jobs)]
    shares += [[index] for index in waiting if jobs[index].bed]

    def run(share: tuple[int, list[int]]) -> None:
        number, indices = share
        decks = [deck for index in indices if (deck := jobs[index].deck) is not None]
        folder = work / f"{adapter.name}-{number}"
        found = adapter.run(decks, folder, _time_limit(decks, options))
        for index, result in zip(indices, found, strict=True):
            outcomes[index] = _kept(jobs[index], result, code, cache)
            progress(adapter.name, 1)
            if jobs[index].bed and outcomes[index].measured is not None:
                shutil.rmtree(folder, ignore_errors=True)  # a hundred megabytes that nobody reads again

    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(run, [(number, share) for number, share in enumerate(shares) if share]))
    return [outcomes[index] for index in range(len(jobs))]


def _time_limit(decks: list[Deck], options: Options) -> float:
    """Seconds that each of the decks may take."""
    largest = max((len(deck.scene.particles) * deck.scene.steps for deck in decks), default=0)
    return max(options.time_limit, SLOWEST * largest)


def _stored(job: _Job, code: Code | None, options: Options, cache: Cache) -> Outcome | None:
    """The record of an earlier run of the same deck, or None."""
    if job.deck is None or options.live:
        return None
    if job.bed:
        return _stored_bed(job, code, options, cache)
    if code is not None:
        key, origin = code_key(job.deck, code), "cache"
        folder, record = cache.folder(key), cache.get(key)
    else:
        folder, origin = reference.recorded(job.source, job.deck.hash), "recorded"
        record = None if folder is None else read(folder)
    if record is None:
        return None
    return Outcome(job.source, job.scene, record, origin=origin, deck=job.deck, folder=folder)


def _stored_bed(job: _Job, code: Code | None, options: Options, cache: Cache) -> Outcome | None:
    """What was measured of an earlier run of the same deck: in the cache, or recorded where that may stand in."""
    if job.deck is None:
        return None
    if code is not None:
        key = measured_key(code_key(job.deck, code), job.scene)
        stored = cache.measured(key)
        if stored is not None:
            return _measured_outcome(job, stored, "cache", cache.folder(key))
        if not (job.substitute and options.recorded):
            return None
    folder = reference.recorded_measured(job.source, job.deck.hash, job.scene)
    stored = None if folder is None else read_measured(folder)
    if folder is None or stored is None or (code is not None and stored.header.code != code):
        return None  # an ensemble is of one version
    return _measured_outcome(job, stored, "recorded", folder)


def _kept(job: _Job, result: RunRecord | RunFailed, code: Code | None, cache: Cache) -> Outcome:
    """The outcome of a finished run; its record goes into the cache."""
    if isinstance(result, RunFailed):
        return Outcome(job.source, job.scene, None, not_run(str(result)), "not run", job.deck)
    if job.bed and code is not None and job.deck is not None:
        return _measured(job, result, measured_key(code_key(job.deck, code), job.scene), cache)
    folder = None if code is None or job.deck is None else cache.put(code_key(job.deck, code), result)
    return Outcome(job.source, job.scene, result, deck=job.deck, folder=folder)
