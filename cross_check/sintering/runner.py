"""Makes the runs of the study: parents before their branches, several at a time, none twice."""

from __future__ import annotations

import multiprocessing
import shutil
import tempfile
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path

from cross_check.engine import CaseError
from cross_check.record import RecordError
from cross_check.sintering import outcome, scenes
from cross_check.sintering.errors import StudyError
from cross_check.sintering.measures import measure
from cross_check.sintering.outcome import Outcome
from cross_check.sintering.plan import Run
from cross_check.sintering.scenes import Planned

Progress = Callable[[str, int], None]
Outcomes = dict[Run, Outcome]
RECORD = "record-"


def execute(planned: list[Planned], out: Path, jobs: int, live: bool, progress: Progress) -> Outcomes:
    """The outcome of every run; what `out/runs` already holds is not run again unless `live`.

    A run that fails leaves its reason in its own outcome and in those of its branches, and nothing in `out/runs`.
    """
    runs, states = out / "runs", out / "states"
    runs.mkdir(parents=True, exist_ok=True)
    for left in out.glob(f"{RECORD}*"):
        shutil.rmtree(left, ignore_errors=True)  # of a study that was stopped
    found: Outcomes = {}
    for item in planned:
        stored = None if live else outcome.kept(item.run, runs, item.key)
        if stored is not None:
            found[item.run] = stored
            progress(item.run.case, 1)
    missing = [item for item in planned if item.run not in found]
    for item, result in _made(missing, found, out, jobs):
        found[item.run] = result
        progress(item.run.case, 1)
        if all(other.run in found for other in planned if other.series == item.series):
            shutil.rmtree(states / item.series, ignore_errors=True)  # no branch of this series is left
    return {item.run: found[item.run] for item in planned}


def _made(missing: list[Planned], found: Outcomes, out: Path, jobs: int) -> Iterator[tuple[Planned, Outcome]]:
    """Runs what is missing, each as soon as its parent is there, in the order of the plan."""
    waiting = list(missing)
    with _workers(jobs) as submit:
        running: dict[Future[Outcome], Planned] = {}
        while waiting or running:
            ready = [item for item in waiting if item.run.parent is None or item.run.parent in found]
            for item in ready:
                parent = None if item.run.parent is None else found[item.run.parent]
                if parent is not None and parent.failure:
                    waiting.remove(item)
                    yield item, Outcome(item.run, failure=f"{parent.run.name}: {parent.failure}", origin="not run")
                elif len(running) < jobs:
                    waiting.remove(item)
                    running[submit(item, out)] = item
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                item = running.pop(future)
                yield item, _result(future, item)


def _result(future: Future[Outcome], item: Planned) -> Outcome:
    """The outcome of a run. Raises StudyError where its process was killed: what is done is kept."""
    try:
        return future.result()
    except BrokenProcessPool as error:
        raise StudyError(f"{item.run.name}: its process was killed; the same command goes on from here") from error


@contextmanager
def _workers(jobs: int) -> Generator[Callable[[Planned, Path], Future[Outcome]]]:
    """Starts runs in processes of their own; a single one at a time runs in this process."""
    if jobs > 1:
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(jobs, mp_context=context) as pool:
            yield lambda item, out: pool.submit(perform, item, out)
        return

    def here(item: Planned, out: Path) -> Future[Outcome]:
        future: Future[Outcome] = Future()
        future.set_result(perform(item, out))
        return future

    yield here


def perform(item: Planned, out: Path) -> Outcome:
    """Makes one run, measures its record, and keeps what was measured; the record itself is not kept."""
    states = out / "states" / item.series
    states.mkdir(parents=True, exist_ok=True)
    try:
        with tempfile.TemporaryDirectory(dir=out, prefix=RECORD) as folder:
            record = scenes.simulate(item.scene, Path(folder), states, item.save_at)
            numbers, arrays = measure(item.run, item.scene, record)
    except (CaseError, RecordError, OSError) as error:
        return Outcome(item.run, failure=str(error), origin="not run")
    header = record.header
    result = Outcome(
        item.run,
        numbers,
        arrays,
        wall_time=header.wall_time,
        steps=header.steps,
        time_step=header.time_step,
        machine=header.machine,
    )
    outcome.keep(result, out / "runs", item.key)
    return result
