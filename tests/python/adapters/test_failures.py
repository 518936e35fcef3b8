"""Programs that are missing, of another version, hang, crash or write rubbish: a clear failure, never a record."""

from __future__ import annotations

import stat
import time
from pathlib import Path

import pytest

from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import RunFailed
from cross_check.record import RunRecord

from . import scenes

WHOLE = scenes.sampled(scenes.pair("on"), 500)
STEPS = range(0, WHOLE.steps + 1, WHOLE.output_every)
COLUMNS = "id xu yu zu vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz"
BOX = "ITEM: BOX BOUNDS ff ff ff\n-0.1 0.1\n-0.1 0.1\n-0.1 0.1\n"
VERSIONS = {
    "liggghts": "LIGGGHTS-PUBLIC 9.9.9, x",
    "yade": "Yade version: 2031.01 ",
    "lammps": "Simulator - 1 Jan 2031",
}


def frames(columns: str, steps: list[int] | range, rows: list[str]) -> str:
    """A dump as LIGGGHTS and LAMMPS write it."""
    head = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n2\n" + BOX + f"ITEM: ATOMS {columns}\n"
    return "".join(head.format(step) + "".join(f"{row}\n" for row in rows) for step in steps)


GOOD = frames(COLUMNS, STEPS, [f"{i} " + " ".join(["0.5"] * 15) for i in (1, 2)])
START = frames(
    "id type mass radius",
    [0, WHOLE.steps],
    [f"{i + 1} 1 {p.mass:.17g} {p.radius:.17g}" for i, p in enumerate(WHOLE.particles)],
)


def install(code: str, folder: Path, monkeypatch: pytest.MonkeyPatch, action: str) -> None:
    """A fake program: says a version when asked for one, else does `action` (lines of sh)."""
    program = folder / f"fake-{code}"
    asked = "--version" if code == "yade" else "-h"
    program.write_text(f'#!/bin/sh\nif [ "$1" = {asked} ]; then echo "{VERSIONS[code]}"; exit 0; fi\n{action}\n')
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv(f"CROSSGRAIN_{code.upper()}", str(program))


def outcome(code: str, folder: Path, time_limit: float = 20.0) -> RunRecord | RunFailed:
    """What the adapter makes of the program installed."""
    return ADAPTERS[code].run([ADAPTERS[code].deck(WHOLE)], folder / "run", time_limit)[0]


def write(history: str, start: str = START) -> str:
    """An action that writes the two dumps."""
    return f"cat > history.dump <<'EOF'\n{history}EOF\ncat > particles.dump <<'EOF'\n{start}EOF"


@pytest.mark.parametrize("code", list(ADAPTERS))
def test_a_missing_program_is_told(code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(f"CROSSGRAIN_{code.upper()}", str(tmp_path / "absent"))
    assert ADAPTERS[code].installed() is None
    failure = outcome(code, tmp_path)
    assert isinstance(failure, RunFailed)
    assert str(failure).startswith(f"{code} is not installed")


@pytest.mark.parametrize("code", list(ADAPTERS))
def test_another_version_is_seen_and_is_not_proved(code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(code, tmp_path, monkeypatch, "exit 0")
    found = ADAPTERS[code].installed()
    assert found is not None
    assert found.version in VERSIONS[code]
    assert found.version not in ADAPTERS[code].proved_versions
    assert found.package == "unknown"


@pytest.mark.parametrize("code", ["liggghts", "lammps"])
def test_a_good_dump_becomes_a_record(code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(code, tmp_path, monkeypatch, write(GOOD))
    record = outcome(code, tmp_path)
    assert isinstance(record, RunRecord)
    assert record["position"].shape == (5, 2, 3)
    assert record.header.source == code


@pytest.mark.parametrize("code", ["liggghts", "lammps"])
@pytest.mark.parametrize(
    ("action", "message"),
    [
        ("exit 0", "wrote no such file"),
        (": > history.dump; : > particles.dump", "the file ends after 0 of 2 frames"),
        ("echo 'ERROR: lost atoms (thermo.cpp:1)'; exit 1", "ended with exit code 1, saying: ERROR: lost atoms"),
        (write(GOOD) + "\necho 'ERROR on proc 0'", "reported: ERROR on proc 0"),
        ("kill -SEGV $$", "was killed by signal 11"),
        (write(GOOD.replace("0.5", "nan", 1)), "history.dump:10: not 16 finite numbers: '1 nan"),
        (write(GOOD.replace("0.5", "abc", 1)), "history.dump:10: not 16 finite numbers: '1 abc"),
        (write(GOOD.replace("0.5 ", "", 1)), "history.dump:10: not 16 finite numbers"),
        (write(GOOD[: len(GOOD) // 2] + "\n"), "history.dump:"),
        (write(frames(COLUMNS, STEPS[:-1], ["1" + " 0" * 15, "2" + " 0" * 15])), "ends after 4 of 5 frames"),
        (write(GOOD.replace("tqz", "tqz q", 1)), "history.dump:9: 'ITEM: ATOMS id"),
        (write(GOOD.replace("ATOMS\n2", "ATOMS\n1", 1)), "history.dump:4: '1' in place of '2'"),
        (write(GOOD.replace("STEP\n500", "STEP\n501", 1)), "history.dump:13: step '501' in place of 500"),
        (write(GOOD.replace("\n2 0.5", "\n1 0.5", 1)), "particles are missing, doubled or out of order"),
        (write(GOOD + GOOD), "more than the 5 frames"),
        (write(GOOD, START.replace("0.005", "0.006", 1)), "particles.dump:10: radius 0.006"),
    ],
)
def test_what_cannot_be_trusted_is_a_failure(
    code: str, action: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install(code, tmp_path, monkeypatch, action)
    failure = outcome(code, tmp_path)
    assert isinstance(failure, RunFailed)
    assert message in str(failure)
    assert "log.txt" in str(failure)
    assert "\n" not in str(failure)


@pytest.mark.parametrize("code", list(ADAPTERS))
def test_a_program_that_hangs_is_stopped_with_its_children(
    code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begin = 'echo "start 0" > "$6"; ' if code == "yade" else ""
    install(code, tmp_path, monkeypatch, f"{begin}sh -c 'sleep 3; touch {tmp_path}/survivor' & sleep 60")
    begun = time.perf_counter()
    failure = outcome(code, tmp_path, time_limit=0.5)
    assert isinstance(failure, RunFailed)
    assert "did not finish within 0.5 s" in str(failure)
    assert time.perf_counter() - begun < 30.0
    time.sleep(3.2)
    assert not (tmp_path / "survivor").exists()


def test_results_of_an_earlier_run_are_not_taken_for_new_ones(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install("lammps", tmp_path, monkeypatch, write(GOOD))
    assert isinstance(outcome("lammps", tmp_path), RunRecord)
    install("lammps", tmp_path, monkeypatch, "exit 0")
    assert isinstance(outcome("lammps", tmp_path), RunFailed)


@pytest.mark.parametrize(
    ("action", "message"),
    [
        ("exit 0", "ended with exit code 0 before the first deck"),
        ("echo no module; exit 3", "ended with exit code 3 before the first deck, saying: no module"),
        ("echo 'start 0' > $6; exit 134", "ended with exit code 134"),
        ("echo 'start 0' > $6; echo 'failed 0 0.1' >> $6", "failed"),
        ("(echo 'start 0'; echo 'done 0 0.1') > $6", "particles.txt: the run wrote no such file"),
    ],
)
def test_a_yade_that_fails_is_told(action: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install("yade", tmp_path, monkeypatch, action)
    failure = outcome("yade", tmp_path)
    assert isinstance(failure, RunFailed)
    assert message in str(failure)
    assert "log.txt" in str(failure)


TABLE_HEAD = "step id x y z vx vy vz wx wy wz fx fy fz tx ty tz\n"
TABLE = TABLE_HEAD + "".join(f"{step} {i}" + " 0.5" * 15 + "\n" for step in STEPS for i in (0, 1))


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (TABLE, ""),
        (TABLE.replace("0.5", "nan", 1), "particles.txt:2: not 17 finite numbers: '0 0 nan"),
        (TABLE.replace(" 0.5", "", 1), "particles.txt:2: not 17 finite numbers"),
        (TABLE.replace("tz", "tz q", 1), "particles.txt:1: 'step id x"),
        (TABLE.replace("500 1", "500 2", 1), "particles.txt:5: step or id out of order"),
        (TABLE.replace("1500 0", "1400 0", 1), "particles.txt:8: step or id out of order"),
        (TABLE[: TABLE.index("2000")], "the file ends after 8 of 10 rows"),
        (TABLE_HEAD, "the file ends after 0 of 10 rows"),
        (TABLE[:-20] + "\n", "not 17 finite numbers"),
    ],
)
def test_a_yade_table_that_is_not_as_ordered_is_a_failure(
    table: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_table = f'cd "$(dirname "$(cat $5)")"; cat > particles.txt <<\'EOF\'\n{table}EOF\n'
    action = write_table + "(echo 'start 0'; echo 'done 0 0.1') > $6"
    install("yade", tmp_path, monkeypatch, action)
    result = outcome("yade", tmp_path)
    if not message:
        assert isinstance(result, RunRecord)
        return
    assert isinstance(result, RunFailed)
    assert message in str(result)
    assert "log.txt" in str(result)
