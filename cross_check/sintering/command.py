"""The study as a command: plan, run, judge, report."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from cross_check.compare.verdicts import Comparison
from cross_check.sintering import judgement, measures, report, runner, scenes
from cross_check.sintering.errors import StudyError
from cross_check.sintering.plan import PLAIN, plan
from cross_check.sintering.study import Study
from cross_check.sintering.targets import judge, targets


@dataclass(frozen=True)
class Options:
    """How the study is run.

    Its form, seeds of every sample (the plan's if None), runs at a time, nothing kept used, and whether it draws.
    """

    full: bool = False
    seeds: int | None = None
    jobs: int = 1
    live: bool = False
    figures: bool = True
    expected: Path | None = None


@dataclass(frozen=True)
class Result:
    """The page, the verdicts, and lines that tell the time of the runs and which of them failed."""

    page: Path
    verdicts: list[Comparison]
    lines: list[str]


def run(options: Options, out: Path, progress: Callable[[int], AbstractContextManager[runner.Progress]]) -> Result:
    """Runs the study into `out`. Raises CaseError, StudyError or ExpectationError before anything is run."""
    started, begin = datetime.now().astimezone().isoformat(timespec="seconds"), time.monotonic()
    asked = targets()
    planned = scenes.prepare(plan(options.full, options.seeds), measures.version())
    out.mkdir(parents=True, exist_ok=True)
    with progress(len(planned)) as told:
        outcomes = runner.execute(planned, out, options.jobs, options.live, told)
    if all(outcome.failure for outcome in outcomes.values()):
        raise StudyError(next(outcome.failure for outcome in outcomes.values()))
    plain = next(item for item in planned if item.run.mode == PLAIN)
    study = Study(outcomes, options.full, dict(plain.scene["model"]["normal"]), options.seeds)
    rows = [judge(target, study) for target in asked]
    verdicts = judgement.comparisons(rows, options.full, options.expected)
    page = report.write(out, study, rows, verdicts, report.Started(started, time.monotonic() - begin), options.figures)
    return Result(page, verdicts, [*_failures(study), *_rates(study)])


def _failures(study: Study) -> list[str]:
    return [f"{run.name}: {outcome.failure}" for run, outcome in study.outcomes.items() if outcome.failure]


def _rates(study: Study) -> list[str]:
    """Time per particle and step by the number of disks, over all runs that are there."""
    lines: list[str] = []
    for count in sorted({run.count for run in study.outcomes}):
        found = [outcome for run, outcome in study.outcomes.items() if run.count == count and not outcome.failure]
        steps, seconds = sum(outcome.steps for outcome in found), sum(outcome.wall_time for outcome in found)
        if steps:
            lines.append(f"N = {count}: {1e6 * seconds / (steps * count):.3f} us per particle-step, {seconds:.0f} s")
    return lines
