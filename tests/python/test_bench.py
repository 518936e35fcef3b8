"""The command `cross-check bench` on a small bed; its times are read and never judged."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from cross_check import bench
from cross_check.adapters import ADAPTERS
from cross_check.cli import main


def test_every_code_is_listed_with_its_time_or_the_reason(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(ADAPTERS["yade"], "installed", lambda: None)
    out = tmp_path / "out"
    arguments = ["bench", "--out", str(out), "--particles", "1000", "--steps", "500", "--repeats", "1"]
    done = CliRunner().invoke(main, arguments, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    entries = {entry["code"]: entry for entry in json.loads((out / "bench.json").read_text())}
    assert list(entries) == ["native", *(contestant.name for contestant in bench.CONTESTANTS)]
    assert entries["yade"]["note"] == "not installed"
    assert entries["yade"]["ns_per_particle_step"] is None
    assert entries["native"]["ratio"] == 1.0
    for entry in entries.values():
        assert entry["state"] == "jammed-bed-1000-seed-1"
        assert (entry["threads"], entry["particles"]) == (1, 1000)
        if entry["note"] != "not installed":
            assert entry["ns_per_particle_step"] > 0, entry
            assert entry["peak_memory_bytes"] > 1e6, entry
    assert "native" in done.output


def test_decks_have_the_moduli_that_the_engine_formed(tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    command = ["bench", "--cache", str(cache), "--out", str(tmp_path), "--particles", "100", "--seed", "1"]
    command = bench.native_command([*command, "--steps", "1", "--repeats", "1", "--threads", "1"])
    bench.spend(command, tmp_path, 60.0)
    state = cache / "jammed-bed-100-seed-1"
    bed = json.loads((state / "bed.json").read_text())
    (lammps,) = (item for item in bench.CONTESTANTS if item.deck.startswith("gran-hertz-history"))

    def stiffness() -> list[float]:
        lines = bench.deck(lammps, state, 7).splitlines()
        (words,) = (line.split() for line in lines if line.startswith("pair_style"))
        return [float(word) for word in words[2:4]]

    young, poisson = bed["young"], bed["poisson"]
    like = [2.0 / 3.0 * young / (1.0 - poisson**2), 2.0 * young / ((2.0 - poisson) * (1.0 + poisson))]
    assert stiffness() == pytest.approx(like, rel=1e-14)
    # A bed of an earlier version has no such file.
    pair = state / "pair.json"
    text = pair.read_text()
    pair.unlink()
    bench.spend(command, tmp_path, 60.0)
    assert pair.read_text() == text
    pair.write_text(text.replace('"effective_young"', '"effective_young": 3e6, "was"'))
    assert stiffness()[0] == pytest.approx(4e6, rel=1e-14)


def test_a_program_that_fails_is_listed_with_its_log(tmp_path: Path) -> None:
    with pytest.raises(bench.RunFailed, match="false"):
        bench.spend(["false"], tmp_path, 10.0)
    with pytest.raises(bench.RunFailed, match="did not finish within"):
        bench.spend(["sleep", "30"], tmp_path, 0.2)


def test_the_native_engine_says_what_it_used(tmp_path: Path) -> None:
    used = bench.spend(bench.native_command(["--version"]), tmp_path, 60.0)
    assert used.time > 0
    assert used.memory >= 0


def test_memory_is_that_of_the_program_and_not_of_its_parent(tmp_path: Path) -> None:
    ballast = bytearray(200_000_000)
    used = bench.spend(["sleep", "0.2"], tmp_path, 10.0)
    assert len(ballast) > 10 * used.memory > 0
