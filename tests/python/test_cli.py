"""The command `cross-check` from end to end, on the cases of the package."""

from __future__ import annotations

import importlib.metadata
import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from cross_check.adapters import ADAPTERS
from cross_check.cli import AS_EXPECTED, BAD_INPUT, UNEXPECTED, main

installed = pytest.mark.skipif(
    any(adapter.installed() is None for adapter in ADAPTERS.values()), reason="not all reference codes are installed"
)


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "cache"))


def call(*arguments: str) -> Result:
    return CliRunner().invoke(main, list(arguments), catch_exceptions=False)


def verdicts(folder: Path) -> list[dict[str, Any]]:
    return json.loads((folder / "verdicts.json").read_text())


def without_codes(monkeypatch: pytest.MonkeyPatch) -> None:
    for adapter in ADAPTERS.values():
        monkeypatch.setattr(adapter, "installed", lambda: None)


@installed
def test_a_case_runs_everywhere_and_is_compared_anew_from_its_folder(tmp_path: Path) -> None:
    out = tmp_path / "out"
    done = call("run", "chung-ooi-1", "--out", str(out))
    assert done.exit_code == AS_EXPECTED, done.output
    first = verdicts(out)
    assert {item["left"]["source"] for item in first} >= {"native", *ADAPTERS}
    assert not any(item["left"]["recorded"] or item["right"]["recorded"] for item in first)
    assert (out / "report" / "index.html").is_file()
    assert (out / "junit.xml").is_file()
    assert call("compare", str(out)).exit_code == AS_EXPECTED
    assert verdicts(out) == first
    moved = tmp_path / "elsewhere"
    shutil.copytree(out, moved)
    shutil.rmtree(tmp_path / "cache")
    assert call("report", str(moved)).exit_code == 0
    assert verdicts(moved) == first


@installed
def test_a_live_run_repeats_the_cached_one_bit_for_bit(tmp_path: Path) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    assert call("run", "damped-wall", "--no-figures", "--out", str(first)).exit_code == AS_EXPECTED
    assert call("run", "damped-wall", "--no-figures", "--live", "--out", str(second)).exit_code == AS_EXPECTED
    assert verdicts(first) == verdicts(second)


def test_recorded_runs_stand_in_for_missing_codes_and_are_marked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    without_codes(monkeypatch)
    done = call("run", "damped-pair", "--no-figures", "--out", str(tmp_path / "out"))
    assert done.exit_code == AS_EXPECTED, done.output
    for item in verdicts(tmp_path / "out"):
        compared = item["discrepancy"] is not None and item["check"] != "convergence"
        assert (item["left"]["recorded"] or item["right"]["recorded"]) == compared


def test_recorded_runs_do_not_stand_in_for_live_ones(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    without_codes(monkeypatch)
    done = call("run", "free-fall", "--no-figures", "--live", "--out", str(tmp_path / "out"))
    assert done.exit_code == UNEXPECTED
    missing = [item for item in verdicts(tmp_path / "out") if item["right"]["source"] in ADAPTERS]
    assert missing
    assert all(item["verdict"].startswith("not-run(") for item in missing)


@installed
def test_another_version_of_a_code_is_not_comparable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ADAPTERS["lammps"], "proved_versions", ("1 Jan 1970",))
    arguments = ("run", "free-fall", "--no-figures", "--codes", "lammps", "--out", str(tmp_path / "out"))
    assert call(*arguments).exit_code == UNEXPECTED
    (mirror,) = (item for item in verdicts(tmp_path / "out") if item["check"] == "mirror")
    assert mirror["verdict"].startswith("not-comparable(lammps")
    assert "1 Jan 1970" in mirror["verdict"]
    assert call(*arguments, "--any-version").exit_code == AS_EXPECTED


def test_the_matrix_of_a_part_of_the_codes_is_complete(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    without_codes(monkeypatch)
    arguments = ("run", "free-fall", "--no-figures", "--codes", "yade", "--out", str(tmp_path / "out"))
    assert call(*arguments).exit_code == AS_EXPECTED
    assert {item["right"]["source"] for item in verdicts(tmp_path / "out") if item["check"] == "plain"} == {"yade"}


def test_figures_are_left_out_where_asked_and_drawn_by_the_report(tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert call("run", "free-fall", "--codes", "", "--no-figures", "--out", str(out)).exit_code == AS_EXPECTED
    before = verdicts(out)
    assert "Largest displacement over time" not in (out / "report" / "index.html").read_text()
    assert not list(out.rglob("*.svg"))
    assert call("report", str(out)).exit_code == AS_EXPECTED
    assert verdicts(out) == before
    assert "Largest displacement over time" in (out / "report" / "index.html").read_text()


def test_a_case_that_is_no_impact_has_figures_of_what_it_compares(tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert call("run", "free-fall", "--out", str(out)).exit_code == AS_EXPECTED
    drawn = [path.read_text() for path in (out / "report" / "figures").glob("*.svg")]
    assert len(drawn) == 1
    page = (out / "report" / "index.html").read_text()
    assert "Largest displacement over time" in page
    for code in ADAPTERS:
        assert f"{code} - native[{code}]" in page


def test_list_and_doctor_answer_in_json() -> None:
    listed = json.loads(call("list").output)
    assert "standard" in listed["suites"]
    assert {case["case"] for case in listed["cases"]} >= {"chung-ooi-1", "free-fall"}
    parts = {part["name"]: part for part in json.loads(call("doctor").output)}
    assert parts["native"]["present"]
    assert set(ADAPTERS) <= set(parts)


def test_doctor_says_how_to_get_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    without_codes(monkeypatch)
    parts = {part["name"]: part for part in json.loads(call("doctor").output)}
    assert "apt-get install yade" in parts["yade"]["advice"]


def test_doctor_tells_optional_python_parts_and_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    there = importlib.metadata.version

    def version(name: str) -> str:
        if name in ("pandas", "meshio"):
            raise importlib.metadata.PackageNotFoundError(name)
        return there(name)

    monkeypatch.setattr(importlib.metadata, "version", version)
    monkeypatch.setattr(os, "cpu_count", lambda: 8)

    def usable(process: int) -> set[int]:
        assert process == 0
        return {0, 1, 2}

    monkeypatch.setattr(os, "sched_getaffinity", usable, raising=False)
    parts = {part["name"]: part for part in json.loads(call("doctor").output)}
    assert not parts["meshio"]["present"]
    assert parts["meshio"]["advice"] == "pip install meshio"
    assert parts["pandas"]["advice"].startswith("optional, for tables")
    assert parts["numpy"]["version"] == there("numpy")
    assert {"vtk", "nbclient", "ovito", "mpi"} <= set(parts)
    assert parts["cores"]["version"].startswith("3 of 8")
    assert "--jobs 3" in parts["cores"]["advice"]


def test_decks_of_a_file_anywhere_are_the_same_bytes_twice(tmp_path: Path) -> None:
    case = tmp_path / "own.toml"
    listed = Path(__file__).parents[2] / "cross_check" / "cases" / "damped_pair.toml"
    case.write_text(listed.read_text())
    for code in ADAPTERS:
        for copy in ("one", "two"):
            assert call("deck", str(case), "--code", code, "--out", str(tmp_path / code / copy)).exit_code == 0
        one, two = (sorted((tmp_path / code / copy).rglob("*.*")) for copy in ("one", "two"))
        assert [path.name for path in one] == [path.name for path in two]
        assert [path.read_bytes() for path in one if path.is_file()] == [
            path.read_bytes() for path in two if path.is_file()
        ]
        assert any(path.name == "translation.json" for path in one)


def test_a_deck_that_no_code_can_state_is_refused(tmp_path: Path) -> None:
    done = call("deck", "chung-ooi-3-critical", "--code", "yade", "--out", str(tmp_path / "deck"))
    assert done.exit_code == BAD_INPUT
    assert "YADE always cuts" in done.output


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("run", "no-such-suite"), "no such suite, case or file"),
        (("run", "fine-powders"), "has no cases in this version"),
        (("run", "free-fall", "--codes", "mercury"), "no such code mercury"),
        (("run", "missing.toml"), "missing.toml"),
        (("report", "nowhere"), "not a kept campaign"),
    ],
)
def test_what_cannot_run_is_one_line_and_exit_code_2(arguments: tuple[str, ...], words: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(main, [*arguments, *(["--out", str(tmp_path / "out")] if arguments[0] == "run" else [])])
    assert done.exit_code == BAD_INPUT
    assert words in done.output
    assert len(done.output.strip().splitlines()) == 1
