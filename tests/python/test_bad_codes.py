"""Codes that are missing or broken: a verdict that says so, never a traceback or a silent green.

Each program of tests/inputs/bad/codes takes the place of LAMMPS and says what the verdict must say.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from cross_check.cli import UNEXPECTED, main

PROGRAMS = sorted((Path(__file__).parents[1] / "inputs" / "bad" / "codes").glob("*.sh"))


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: path.stem)
def test_a_broken_code_gets_a_verdict_that_says_why(
    program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (expected,) = (line[10:] for line in program.read_text().splitlines() if line.startswith("# expect: "))
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("CROSSGRAIN_LAMMPS", str(program))
    out = tmp_path / "out"
    command = [
        "run",
        "free-fall",
        "--no-figures",
        "--codes",
        "lammps",
        "--live",
        "--time-limit",
        "2",
        "--out",
        str(out),
    ]
    done = CliRunner().invoke(main, command, catch_exceptions=False)
    assert done.exit_code == UNEXPECTED
    against = [item for item in json.loads((out / "verdicts.json").read_text()) if "lammps" in item["right"]["source"]]
    assert against
    for item in against:
        assert item["verdict"].startswith(("not-run(", "not-comparable("))
        assert expected in item["verdict"]
        assert expected in done.output
