"""Speed: the native engine against the installed codes, one thread each, from the same state.

A code is timed from outside and all alike: the processor time of a long run less that of a short one, divided by the
steps between, so that neither start-up nor other work on the machine counts. The codes take turns within every
repetition; a ratio is formed within one repetition, where the machine is the same for both.
"""

from __future__ import annotations

import json
import math
import os
import re
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from cross_check import PACKAGE, engine
from cross_check.adapters import ADAPTERS, lammps, liggghts, yade
from cross_check.adapters import installed as programs
from cross_check.adapters.interface import RunFailed
from cross_check.adapters.render import number, render
from cross_check.adapters.runner import LOG, check_end, start, stop
from cross_check.cache import Cache

DECKS = PACKAGE / "bench_decks"
NATIVE = "native"
SEED = 1
# Steps of the short run, which every code makes before those that count.
WARM_UP = 100
# Pause between two looks at a process [s].
PAUSE = 0.01
# Constant of the dashpot of gran/hertz/history [1/(m s)]: of the size of the others' in the bed.
LAMMPS_DASHPOT = 1e4


class BenchError(Exception):
    """The benchmark cannot be made; the message names the reason."""


@dataclass(frozen=True)
class Contestant:
    """A code with one way to state the law; `slower` divides its steps."""

    name: str
    code: str
    deck: str
    words: tuple[str, ...]
    variable: str
    program: str
    slower: int = 1


CONTESTANTS = (
    Contestant(
        "lammps gran/hertz/history",
        "lammps",
        "gran-hertz-history.lmp",
        ("-in", "{deck}", "-log", "none"),
        lammps.run.VARIABLE,
        lammps.run.PROGRAM,
    ),
    Contestant(
        "lammps granular",
        "lammps",
        "granular.lmp",
        ("-in", "{deck}", "-log", "none"),
        lammps.run.VARIABLE,
        lammps.run.PROGRAM,
    ),
    Contestant(
        "liggghts",
        "liggghts",
        "scene.in",
        ("-in", "{deck}", "-log", "none"),
        liggghts.run.VARIABLE,
        liggghts.run.PROGRAM,
    ),
    Contestant(
        "yade", "yade", "scene.py", ("-n", "-x", "-j1", "{deck}"), yade.run.VARIABLE, yade.run.PROGRAM, slower=10
    ),
)


@dataclass(frozen=True)
class Options:
    """How the benchmark is made."""

    particles: int = 32_000
    steps: int = 300
    repeats: int = 3
    time_limit: float = 3600.0


@dataclass(frozen=True)
class Use:
    """What a process used: processor time [s] and largest resident memory [bytes]."""

    time: float
    memory: int


@dataclass
class Measurement:
    """An entry of bench.json; repeats and ratios are parallel, `ratio` is that to the native engine."""

    state: str
    code: str
    version: str
    threads: int
    particles: int
    steps: int
    ns_per_particle_step: float | None = None
    peak_memory_bytes: int | None = None
    ratio: float | None = None
    repeats: list[float] = field(default_factory=list[float])
    ratios: list[float] = field(default_factory=list[float])
    note: str = ""


def spend(command: list[str], folder: Path, time_limit: float) -> Use:
    """Runs `command` in `folder` and tells what it used. Raises RunFailed."""
    process = start(command, folder, folder / LOG)
    begin, memory = time.monotonic(), 0
    try:
        while True:
            # The system counts the largest memory of a process from before it became this program: it has to be asked.
            memory = max(memory, _peak_memory(process.pid))
            ended, status, used = os.wait4(process.pid, os.WNOHANG)
            if ended:
                break
            if time.monotonic() - begin > time_limit:
                reason = f"did not finish within {time_limit:g} s and was stopped"
                raise RunFailed(f"{command[0]} {reason}; log: {folder / LOG}")
            time.sleep(PAUSE)
        code = process.returncode = os.waitstatus_to_exitcode(status)
    finally:
        if process.returncode is None:
            stop(process)
    check_end(command[0], code, folder / LOG)
    return Use(used.ru_utime + used.ru_stime, memory)


def _peak_memory(pid: int) -> int:
    """Largest resident memory of a process so far [bytes]; 0 where the system does not tell."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0
    found = re.search(r"^VmHWM:\s+(\d+) kB", status, re.MULTILINE)
    return 1024 * int(found.group(1)) if found else 0


def native_command(arguments: list[str]) -> list[str]:
    """The command line of the native engine."""
    program = os.environ.get(engine.PROGRAM_VARIABLE)
    if program is not None:
        return [program, *arguments]
    return [sys.executable, "-c", "import sys, crossgrain; sys.exit(crossgrain.main(sys.argv[1:]))", *arguments]


def _native(options: Options, cache: Path, folder: Path, steps: int) -> Use:
    arguments = ["bench", "--cache", str(cache), "--out", str(folder), "--particles", str(options.particles)]
    arguments += ["--seed", str(SEED), "--steps", str(steps), "--repeats", "1", "--threads", "1"]
    return spend(native_command(arguments), folder, options.time_limit)


def deck(contestant: Contestant, state: Path, steps: int) -> str:
    """The deck of `steps` steps from the bed in the folder `state`, with the mixed values that the engine formed."""
    bed: dict[str, Any] = json.loads((state / "bed.json").read_text())
    pair: dict[str, Any] = json.loads((state / "pair.json").read_text())
    # The words of gran/hertz/history: Kn = 4/3 E* and Kt = 8 G*.
    normal = 4.0 / 3.0 * float(pair["effective_young"])
    tangential = 8.0 * float(pair["effective_shear"])
    values = {key: number(float(bed[key])) for key in ("young", "poisson", "density", "restitution", "friction")}
    values |= {key: number(float(bed[key])) for key in ("edge", "radius", "time_step")}
    values |= {"normal": number(normal), "tangential": number(tangential), "dashpot": number(LAMMPS_DASHPOT)}
    values |= {"skin": number(0.4 * float(bed["radius"])), "steps": str(steps)}
    values |= {"state": state.name, "data": "bed.data", "columns": "bed.npz"}
    return render(DECKS / f"{contestant.deck}.j2", dict(values))


def _external(contestant: Contestant, options: Options, state: Path, folder: Path, steps: int) -> Use:
    path = programs.executable(contestant.variable, contestant.program)
    if path is None:
        raise BenchError(f"{contestant.code} is gone")
    (folder / contestant.deck).write_text(deck(contestant, state, steps))
    # LIGGGHTS takes no comment behind a heading.
    (folder / "bed.data").write_text((state / "bed.data").read_text().replace("Atoms # sphere", "Atoms"))
    if not (folder / "bed.npz").exists():
        (folder / "bed.npz").symlink_to((state / "bed.npz").resolve())
    command = [path, *(word.format(deck=contestant.deck) for word in contestant.words)]
    return spend(command, folder, options.time_limit)


def _time(entry: Measurement, run: Callable[[Path, int], Use], steps: int) -> None:
    with tempfile.TemporaryDirectory(prefix="crossgrain-bench-") as folder:
        short = run(Path(folder), WARM_UP)
        long = run(Path(folder), WARM_UP + steps)
    spent = (long.time - short.time) * 1e9 / (steps * entry.particles)
    if not spent > 0.0:
        raise RunFailed(f"{steps} steps of {entry.particles} particles are too few to be timed")
    entry.repeats.append(spent)
    entry.peak_memory_bytes = max(entry.peak_memory_bytes or 0, long.memory) or None


def run(options: Options, out: Path, progress: Callable[[str, int], None]) -> list[Measurement]:
    """Times all codes and writes `out`/bench.json; `progress` hears the code and the number of finished turns."""
    if options.particles < 1 or options.steps < 1 or options.repeats < 1:
        raise BenchError("particles, steps and repeats: at least 1 each")
    cache = Cache().root / "beds"
    state = cache / f"jammed-bed-{options.particles}-seed-{SEED}"
    out.mkdir(parents=True, exist_ok=True)
    # Builds the bed where there is none: no measurement does.
    with tempfile.TemporaryDirectory(prefix="crossgrain-bench-") as folder:
        _native(options, cache, Path(folder), 1)
    native = Measurement(state.name, NATIVE, engine.version(), 1, options.particles, options.steps)
    entries = [native]
    turns: list[tuple[Measurement, Callable[[Path, int], Use]]] = [
        (native, lambda folder, steps: _native(options, cache, folder, steps))
    ]
    for contestant in CONTESTANTS:
        code = ADAPTERS[contestant.code].installed()
        steps = max(1, options.steps // contestant.slower)
        entry = Measurement(state.name, contestant.name, code.version if code else "", 1, options.particles, steps)
        entries.append(entry)
        if code is None:
            entry.note = "not installed"
            progress(contestant.name, options.repeats)
            continue
        turns.append((entry, lambda folder, steps, own=contestant: _external(own, options, state, folder, steps)))
    for _ in range(options.repeats):
        for entry, turn in turns:
            if not entry.note:
                try:
                    _time(entry, turn, entry.steps)
                except RunFailed as error:
                    entry.note = str(error)
            progress(entry.code, 1)
    if native.note:
        raise BenchError(native.note)
    for entry in entries:
        _conclude(entry, native)
    text = json.dumps([asdict(entry) for entry in entries], indent=1)
    (out / "bench.json").write_text(text + "\n")
    return entries


def _conclude(entry: Measurement, native: Measurement) -> None:
    if not entry.repeats:
        return
    entry.ns_per_particle_step = statistics.median(entry.repeats)
    pairs = zip(entry.repeats, native.repeats, strict=False)
    entry.ratios = [one / other for one, other in pairs]
    entry.ratio = statistics.median(entry.ratios)


def table(entries: list[Measurement]) -> list[str]:
    """The measurements as aligned lines: median, spread, ratio to the native engine, memory of the process."""
    lines = [f"{'code':28} {'ns per particle-step':>22} {'spread':>15} {'ratio':>7} {'spread':>13} {'MB':>6}"]
    for entry in entries:
        if entry.ns_per_particle_step is None:
            lines.append(f"{entry.code:28} {entry.note}")
            continue
        low, high = min(entry.repeats), max(entry.repeats)
        ratio, memory = entry.ratio or math.nan, (entry.peak_memory_bytes or 0) / 1e6
        least, most = min(entry.ratios), max(entry.ratios)
        lines.append(
            f"{entry.code:28} {entry.ns_per_particle_step:22.1f} {f'{low:.0f} - {high:.0f}':>15} {ratio:7.2f} "
            f"{f'{least:.2f} - {most:.2f}':>13} {memory:6.0f}"
        )
    return lines
