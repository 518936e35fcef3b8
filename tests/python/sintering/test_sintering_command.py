"""The study as a command, from end to end, on made-up runs."""

from __future__ import annotations

import csv
import json
import re
import runpy
from pathlib import Path
from typing import Any

import made_up_runs
import pytest
from click.testing import CliRunner, Result

import crossgrain
from cross_check.cli import BAD_INPUT, UNEXPECTED, main
from cross_check.compare.expectations import rules
from cross_check.compare.verdicts import DIFFER
from cross_check.engine import CaseError
from cross_check.report import notation
from cross_check.report.figures import Figured
from cross_check.report.notation import ABSENT
from cross_check.sintering import figures, judgement, plan, runner, scenes
from cross_check.sintering.plan import Run
from cross_check.sintering.scenes import Planned
from cross_check.sintering.study import Study

DOCS = Path(__file__).parents[3] / "docs"


@pytest.fixture(autouse=True)
def made_up(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The made-up engine in place of the native one; the list fills with the names of what it runs."""
    ran: list[str] = []

    def simulate(scene: dict[str, Any], folder: Path, states: Path, save_at: list[int]) -> object:
        ran.append(f"{scene['case']}/{scene['variant']}")
        return made_up_runs.simulate(scene, folder, states, save_at)

    monkeypatch.setattr(scenes, "load", made_up_runs.scene)
    monkeypatch.setattr(scenes, "simulate", simulate)
    monkeypatch.setattr(crossgrain, "sintering_contact", made_up_runs.contact, raising=False)
    monkeypatch.setattr(crossgrain, "sintering_stiffness", made_up_runs.softening, raising=False)
    return ran


@pytest.fixture
def without_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Drawing takes most of the time of a made-up study."""

    def nothing(study: Study, folder: Path) -> tuple[list[Figured], list[str]]:
        return [], []

    monkeypatch.setattr(figures, "draw_all", nothing)


def study(out: Path, *arguments: str) -> Result:
    command = ["run", "sintering", "--jobs", "1", "--out", str(out), *arguments]
    return CliRunner().invoke(main, command, catch_exceptions=False)


def test_the_quick_form_judges_draws_and_leaves_the_rest_to_the_full_one(tmp_path: Path, made_up: list[str]) -> None:
    done = study(tmp_path)
    assert done.exit_code == UNEXPECTED, done.output  # the runs are made up
    assert len(made_up) == 16
    verdicts = json.loads((tmp_path / "verdicts.json").read_text())
    found = {item["verdict"] for item in verdicts}
    assert found == {"agree", "differ", "not-run(full only)"}
    assert all(item["verdict"] == "not-run(full only)" for item in verdicts if "N=300" in item["case"])
    figures = {path.stem for path in (tmp_path / "figures").glob("*.svg")}
    assert figures >= {f"figure-{number:02}" for number in (3, 5, 6, *range(8, 18), 20, 21, 22)}
    assert figures == {path.stem for path in (tmp_path / "figures").glob("*.pdf")}
    with (tmp_path / "table.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {row["Verdict"] for row in rows} >= {"met", "missed", "reported", "full only"}
    assert "figure-20" in (tmp_path / "report" / "index.html").read_text()
    assert not list((tmp_path / "states").iterdir())


@pytest.mark.usefixtures("without_figures")
def test_a_study_that_was_stopped_goes_on_where_it_was(tmp_path: Path, made_up: list[str]) -> None:
    study(tmp_path)
    made_up.clear()
    verdicts = (tmp_path / "verdicts.json").read_text()
    study(tmp_path)
    assert made_up == []
    assert (tmp_path / "verdicts.json").read_text() == verdicts
    kept = sorted((tmp_path / "runs").glob("*.json"))
    kept[0].unlink()  # one run was not finished, one file was cut short
    kept[1].write_text(kept[1].read_text()[:40])
    study(tmp_path)
    assert len(made_up) == 2
    assert (tmp_path / "verdicts.json").read_text() == verdicts


@pytest.mark.usefixtures("without_figures")
def test_a_run_that_fails_takes_its_branches_along_and_turns_the_study_red(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def breaks(scene: dict[str, Any], folder: Path, states: Path, save_at: list[int]) -> object:
        if scene["case"] == "sintering-cooled" and scene["variant"] == "p=100,N=100,t=1":
            raise CaseError("the wall flew away")
        return made_up_runs.simulate(scene, folder, states, save_at)

    monkeypatch.setattr(scenes, "simulate", breaks)
    done = study(tmp_path)
    assert done.exit_code == UNEXPECTED
    verdicts = json.loads((tmp_path / "verdicts.json").read_text())
    failed = [item for item in verdicts if "the wall flew away" in item["verdict"]]
    assert {item["quantity"] for item in failed} >= {"T9b-rise", "T17-strength", "T22-block"}
    assert not any(item["as_expected"] for item in failed)
    assert len(list((tmp_path / "runs").glob("*.json"))) == 13


def test_a_branch_that_starts_from_another_scene_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def other(run: Any) -> dict[str, Any]:
        found = made_up_runs.scene(run)
        if run.test == "box":
            found["model"] = {"normal": made_up_runs.LAW | {"k1": 2e5}}
        return found

    monkeypatch.setattr(scenes, "load", other)
    done = study(tmp_path)
    assert done.exit_code == BAD_INPUT
    assert "scene.model.normal.k1 differs" in done.output
    assert "sintering-cooled/p=10,N=100,t=0.01/seed=1" in done.output


def test_runs_beside_each_other_have_processes_of_their_own(tmp_path: Path) -> None:
    runs = [Run(plan.THREE, pressure, 3, 1) for pressure in plan.PRESSURES]
    planned = [Planned(run, {"nothing": 1}, run.name.replace("/", " "), "series") for run in runs]
    told: list[str] = []
    found = runner.execute(planned, tmp_path, 2, live=False, progress=lambda case, _: told.append(case))
    assert [found[run].run for run in runs] == runs
    assert all("scene" in found[run].failure for run in runs)  # the native engine refuses it
    assert told == ["sintering-three"] * 2
    assert not list((tmp_path / "runs").iterdir())


@pytest.mark.usefixtures("without_figures")
def test_the_page_of_the_documentation_says_what_the_table_says(tmp_path: Path) -> None:
    study(tmp_path)
    with (tmp_path / "table.csv").open() as file:
        judged = [row for row in csv.DictReader(file) if row["Threshold"] != ABSENT]
    missed = [row for row in judged if row["Verdict"] == "missed"]
    page: str = runpy.run_path(str(DOCS / "sintering_page.py"))["page"](tmp_path, "2026-11-22")
    met = sum(row["Verdict"] == "met" for row in judged)
    assert f"{met} of {len(judged)} targets are met" in page
    assert missed
    for row in missed:
        value, space, unit = row["Measured"].partition(" ")
        cell = f"{notation.number(float(value), 4)}{space}{unit} (0/1) **missed**"
        assert f"- {row['Target']}, p={row['p [N/m]']},N={row['N']}: {cell}; asked: {row['Threshold']}" in page
        assert f"| {cell} |" in page


def test_the_page_of_the_documentation_holds_what_the_full_form_is_expected_to_miss() -> None:
    page = (DOCS / "sintering-results.md").read_text(encoding="utf-8")
    missed = [rule for rule in rules(judgement.EXPECTED[True]) if rule.verdict == DIFFER]
    judged = sum(rule.count for rule in rules(judgement.EXPECTED[True]))
    met = judged - sum(rule.count for rule in missed)
    assert f"{met} of {judged} targets are met" in page
    assert page.count("**missed**; asked:") == judged - met
    assert all(rule.why and rule.why in page for rule in missed)
    pictures = re.findall(r"\]\((figures/\S+)\)", page)
    assert pictures
    assert all((DOCS / name).is_file() for name in pictures)
