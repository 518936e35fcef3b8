"""Runs YADE decks, many in one process, and reads what they wrote.

A deck that fails or hangs leaves the others alone. When the process dies under a deck, that deck is run once more on
its own and the decks behind it go on in a new process.
"""

from __future__ import annotations

import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cross_check.adapters import installed as programs
from cross_check.adapters.interface import Deck, RunFailed
from cross_check.adapters.runner import LOG, deck_folder, missing, record_of, start, stop, with_log
from cross_check.adapters.yade.parse import read_run
from cross_check.adapters.yade.translate import CONTACTS, PARTICLES, WALLS
from cross_check.record import Code, RunRecord

VARIABLE = "CROSSGRAIN_YADE"
PROGRAM = "yade"
BATCH = Path(__file__).resolve().with_name("batch.py")
# Longest start [s]; about 2 s on an idle machine.
START_LIMIT = 60.0
# Pause between looks at the progress of a batch [s].
PAUSE = 0.02


@dataclass
class _Progress:
    """How far a batch came: wall time [s] of the finished decks, decks that raised, the deck under way, its trouble."""

    done: dict[int, float] = field(default_factory=dict[int, float])
    failed: set[int] = field(default_factory=set[int])
    current: int | None = None
    trouble: str = ""
    hung: bool = False


def installed() -> Code | None:
    """The installed YADE, or None."""
    return programs.installed("yade", VARIABLE, PROGRAM, "--version", r"Yade version: (\S+)")


def run(decks: list[Deck], folder: Path, time_limit: float) -> list[RunRecord | RunFailed]:
    """One result per deck, in order; `time_limit` [s] holds for each."""
    code, program = installed(), programs.executable(VARIABLE, PROGRAM)
    if code is None or program is None:
        return missing(decks, "yade", VARIABLE, PROGRAM)
    own = [deck_folder(folder, index, deck, (PARTICLES, WALLS, CONTACTS)) for index, deck in enumerate(decks)]
    results: dict[int, RunRecord | RunFailed] = {}
    batches = [list(range(len(decks)))] if decks else []
    while batches:
        batch = batches.pop(0)
        progress = _run_batch(program, [own[index] / decks[index].main for index in batch], time_limit)
        for place, index in enumerate(batch):
            if place in progress.done:
                results[index] = _read(decks[index], code, progress.done[place], own[index])
            elif place in progress.failed:
                results[index] = RunFailed(f"{program} failed: {_last_line(own[index])}; log: {own[index] / LOG}")
        batches = _remaining(batch, progress, results, program, own) + batches
    return [results[index] for index in range(len(decks))]


def _remaining(
    batch: list[int],
    progress: _Progress,
    results: dict[int, RunRecord | RunFailed],
    program: str,
    own: Sequence[Path],
) -> list[list[int]]:
    """The batches that are still to run after `batch` ended; decides about the deck under which it ended."""
    if progress.current is None:
        log = own[batch[0]]
        said = f"{progress.trouble} before the first deck, saying: {_last_line(log)}; log: {log / LOG}"
        results.update({index: RunFailed(f"{program} {said}") for index in batch})
        return []
    under_way = batch[progress.current]
    behind = batch[progress.current + 1 :]
    batches: list[list[int]] = []
    if under_way not in results:
        if len(batch) > 1 and not progress.hung:
            batches.append([under_way])
        else:
            said = _last_line(own[under_way])
            results[under_way] = RunFailed(f"{program} {progress.trouble}, saying: {said}; log: {own[under_way] / LOG}")
    if behind:
        batches.append(behind)
    return batches


def _run_batch(program: str, paths: Sequence[Path], time_limit: float) -> _Progress:
    """Runs decks in one process until it ends or one deck takes longer than `time_limit` [s]."""
    with tempfile.TemporaryDirectory(prefix="crossgrain-yade-") as name:
        folder = Path(name)
        listing, report = folder / "decks.txt", folder / "progress.txt"
        listing.write_text("".join(f"{path}\n" for path in paths))
        command = [program, "-n", "-x", "-j1", str(BATCH), str(listing), str(report)]
        progress = _Progress()
        try:
            process = start(command, folder, folder / LOG)
        except RunFailed as failure:
            progress.trouble = str(failure)
            return progress
        try:
            _watch(process, report, time_limit, progress)
        finally:
            if process.poll() is None:
                stop(process)
        if progress.current is None:
            (paths[0].parent / LOG).write_bytes((folder / LOG).read_bytes())
        return progress


def _watch(process: subprocess.Popen[bytes], report: Path, time_limit: float, progress: _Progress) -> None:
    """Follows a batch to its end, or to the deck that takes too long."""
    seen, since = "", time.perf_counter()
    while True:
        code = process.poll()
        text = report.read_text() if report.exists() else ""
        if text != seen:
            seen, since = text, time.perf_counter()
            _read_progress(text, progress)
        if code is not None:
            progress.trouble = f"was killed by signal {-code}" if code < 0 else f"ended with exit code {code}"
            return
        limit = START_LIMIT if progress.current is None else time_limit
        if time.perf_counter() - since > limit:
            progress.trouble, progress.hung = f"did not finish within {limit:g} s and was stopped", True
            return
        time.sleep(PAUSE)


def _read_progress(text: str, progress: _Progress) -> None:
    """Takes over the complete lines of a progress report."""
    for line in text.split("\n")[:-1]:
        words = line.split()
        place = int(words[1])
        if words[0] == "start":
            progress.current = place
        elif words[0] == "done":
            progress.done[place] = float(words[2])
        else:
            progress.failed.add(place)


def _read(deck: Deck, code: Code, wall_time: float, own: Path) -> RunRecord | RunFailed:
    try:
        return record_of(deck, code, wall_time, "half_step", read_run(own, deck.scene), own)
    except RunFailed as failure:
        return with_log(failure, own)


def _last_line(own: Path) -> str:
    """The last line that a deck printed."""
    try:
        lines = (own / LOG).read_text(errors="replace").splitlines()
    except FileNotFoundError:
        return "nothing"
    return next((line.strip() for line in reversed(lines) if line.strip()), "nothing")
