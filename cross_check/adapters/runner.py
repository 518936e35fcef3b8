"""Runs external programs headless: list arguments, own folder, own log, a time limit, and no trust in exit codes."""

from __future__ import annotations

import contextlib
import os
import platform
import re
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cross_check.adapters.interface import Deck, RunFailed
from cross_check.record import Code, Header, RecordError, RunRecord

LOG = "log.txt"
Columns = dict[str, NDArray[Any]]
# LIGGGHTS and LAMMPS start Open MPI even for one process; told to be alone, they start four times as fast.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OMPI_MCA_pml": "ob1"}


def environment(folder: Path) -> dict[str, str]:
    """The environment of an external program: one thread, C locale, where things are, nothing else.

    MPI keeps its session files in `folder`: in a folder that runs share, they remove each other's.
    """
    kept = {key: os.environ[key] for key in ("PATH", "HOME", "TMPDIR", "LD_LIBRARY_PATH") if key in os.environ}
    own = {"OMPI_MCA_orte_tmpdir_base": str(folder.resolve())}
    return kept | ALONE | own | {"OMP_NUM_THREADS": "1", "LC_ALL": "C", "PYTHONDONTWRITEBYTECODE": "1"}


def start(command: Sequence[str], folder: Path, log: Path) -> subprocess.Popen[bytes]:
    """Starts `command` in `folder` as the head of its own process group, output and errors into `log`."""
    with log.open("wb") as output:
        try:
            return subprocess.Popen(  # noqa: S603  a list of words, no shell
                list(command),
                cwd=folder,
                env=environment(folder),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except OSError as error:
            raise RunFailed(f"{command[0]} cannot be started: {error}") from error


def stop(process: subprocess.Popen[bytes]) -> None:
    """Kills the process group of `process` and waits for its end."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def run_program(command: Sequence[str], folder: Path, time_limit: float) -> float:
    """Runs `command` in `folder` to its end and returns the wall time [s]. Raises RunFailed, naming the log."""
    log = folder / LOG
    begin = time.perf_counter()
    process = start(command, folder, log)
    try:
        code = process.wait(timeout=time_limit)
    except subprocess.TimeoutExpired:
        raise RunFailed(f"{command[0]} did not finish within {time_limit:g} s and was stopped; log: {log}") from None
    finally:
        if process.poll() is None:
            stop(process)
    wall_time = time.perf_counter() - begin
    check_end(command[0], code, log)
    return wall_time


def check_end(program: str, code: int, log: Path) -> None:
    """Raises RunFailed for an exit code other than 0 or a log that speaks of an error."""
    lines = log.read_text(errors="replace").splitlines()
    complaint = next((line.strip() for line in lines if "ERROR" in line), None)
    if code != 0:
        end = f"was killed by signal {-code}" if code < 0 else f"ended with exit code {code}"
        said = complaint or next((line.strip() for line in reversed(lines) if line.strip()), "nothing")
        raise RunFailed(f"{program} {end}, saying: {said}; log: {log}")
    if complaint is not None:
        raise RunFailed(f"{program} reported: {complaint}; log: {log}")


def deck_folder(folder: Path, index: int, deck: Deck, outputs: Sequence[str]) -> Path:
    """Makes the folder of one deck below `folder`, writes the deck and removes outputs of an earlier run."""
    name = re.sub(r"[^A-Za-z0-9._=+-]", "-", deck.scene.name).lstrip(".")
    own = folder.resolve() / f"{index:04d}-{name[:80]}"
    own.mkdir(parents=True, exist_ok=True)
    for stale in (LOG, *outputs):
        (own / stale).unlink(missing_ok=True)
    for file, text in deck.files.items():
        (own / file).write_text(text)
    return own


def run_each(
    decks: Sequence[Deck], folder: Path, outputs: Sequence[str], run_one: Callable[[Deck, Path], RunRecord]
) -> list[RunRecord | RunFailed]:
    """Runs the decks one after the other, each in its own folder; a failure of one leaves the others alone."""
    results: list[RunRecord | RunFailed] = []
    for index, deck in enumerate(decks):
        own = deck_folder(folder, index, deck, outputs)
        try:
            results.append(run_one(deck, own))
        except RunFailed as failure:
            results.append(with_log(failure, own))
    return results


def with_log(failure: RunFailed, own: Path) -> RunFailed:
    """The failure of a deck that ran in the folder `own`, naming the log."""
    log = str(own / LOG)
    return failure if log in str(failure) else RunFailed(f"{failure}; log: {log}")


def missing(decks: Sequence[Deck], code: str, variable: str, program: str) -> list[RunRecord | RunFailed]:
    """The results of decks whose program is not installed."""
    reason = f"{code} is not installed: no program {program} on PATH and {variable} names none"
    return [RunFailed(reason) for _ in decks]


def record_of(
    deck: Deck,
    code: Code,
    wall_time: float,
    velocity_time: str,
    columns: Columns,
    where: Path,
    *,
    evaluated_anew: bool = False,
) -> RunRecord:
    """The checked record of one run; `step` and `time` are added to `columns`. Raises RunFailed naming `where`.

    `evaluated_anew`: the code evaluates contact forces for output, with other velocities than its step used.
    """
    scene = deck.scene
    step = np.arange(0, scene.steps + 1, scene.output_every, dtype=np.int64)
    header = Header(
        source=deck.code,
        case=scene.case,
        variant=scene.variant,
        seed=scene.seed,
        refinement=scene.refinement,
        code=code,
        deck_hash=deck.hash,
        machine=f"{platform.machine()}, {os.cpu_count()} cpus",
        wall_time=wall_time,
        time_step=scene.time_step,
        steps=scene.steps,
        velocity_time=velocity_time,
        contact_force="re-evaluated" if evaluated_anew and scene.contacts else "exact",
        mass=[particle.mass for particle in scene.particles],
        radius=[particle.radius for particle in scene.particles],
        bodies=[body.name for body in scene.bodies],
        gravity=list(scene.gravity),
    )
    record = RunRecord(header, {"step": step, "time": step * scene.time_step} | columns)
    try:
        record.check(str(where))
    except RecordError as error:
        raise RunFailed(f"{error}; log: {where / LOG}") from error
    return record
