"""Claims about which seeds of a bed run, which are recorded, and what changed since a baseline."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from small_cases import BED, HEAD, PROFILE, SLIDE, Fake, load

from cross_check import baseline, campaign, measured, recording, regression, runs
from cross_check.baseline import BaselineError
from cross_check.cli import BAD_INPUT, main
from cross_check.compare.changes import BEYOND, IDENTICAL, compare_baselines
from cross_check.compare.verdicts import AGREE, DIFFER
from cross_check.engine import Case, CaseError
from cross_check.record import Code

SEEDS = [1, 2, 3]


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Fake:
    return Fake(monkeypatch, tmp_path)


@pytest.fixture
def case(tmp_path: Path) -> Case:
    return load(BED, tmp_path)


def ignore(source: str, done: int) -> None:
    """A progress that nobody looks at."""


def finish(case: Case, folder: Path, **options: bool) -> campaign.Finished:
    folder.mkdir(exist_ok=True)
    return campaign.run(case.name, [case], runs.Options(codes=("fake",), jobs=1, **options), folder, ignore)


def origins(finished: campaign.Finished, source: str = "fake") -> list[str]:
    return [outcomes[source, 0].origin for outcomes in finished.results.values()]


def record(case: Case, fake: Fake) -> None:
    """Records all seeds, and forgets what ran."""
    assert recording.refresh([case], ignore) == (3, 0)
    fake.ran.clear()


def test_without_recorded_runs_all_seeds_run_and_are_kept(case: Case, fake: Fake, tmp_path: Path) -> None:
    assert origins(finish(case, tmp_path / "one")) == ["live"] * 3
    assert fake.ran == SEEDS
    again = finish(case, tmp_path / "two")
    assert origins(again) == origins(again, "native") == ["cache"] * 3
    assert fake.ran == SEEDS
    for outcomes in again.results.values():
        assert {outcome.record for outcome in outcomes.values()} == {None}
        assert all(outcome.measured is not None for outcome in outcomes.values())


def test_the_first_seed_runs_and_the_others_may_be_recorded(
    case: Case, fake: Fake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(case, fake)
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "empty"))
    found = finish(case, tmp_path / "one")
    assert fake.ran == [1]
    assert origins(found) == ["live", "recorded", "recorded"]
    assert origins(found, "native") == ["live"] * 3
    assert origins(finish(case, tmp_path / "two")) == ["cache", "recorded", "recorded"]
    fake.ran.clear()
    assert origins(finish(case, tmp_path / "three", live=True)) == ["live"] * 3
    assert fake.ran == SEEDS


def test_recorded_runs_stand_in_for_no_seed_where_they_may_not(
    case: Case, fake: Fake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(case, fake)
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "empty"))
    assert origins(finish(case, tmp_path / "one", recorded=False)) == ["live"] * 3
    assert fake.ran == SEEDS


def test_recorded_runs_stand_in_for_all_seeds_of_a_code_that_is_not_there(
    case: Case, fake: Fake, tmp_path: Path
) -> None:
    record(case, fake)
    fake.code = None
    assert origins(finish(case, tmp_path / "one")) == ["recorded"] * 3
    found = finish(case, tmp_path / "two", live=True)
    assert origins(found) == ["not run"] * 3
    verdicts = {item.verdict for item in campaign.comparisons(found) if "fake" in (item.left.source, item.right.source)}
    assert verdicts == {"not-run(fake is not installed and there is no recorded run of this deck)"}


def test_another_deck_or_other_observables_find_no_recorded_run(case: Case, fake: Fake, tmp_path: Path) -> None:
    record(case, fake)
    fake.code = None
    for override in ("particles.0.velocity=0.02", "observables.0.average=0.5"):
        other = load(BED, tmp_path, override)
        assert origins(finish(other, tmp_path / "out")) == ["not run"] * 3


def test_comparisons_are_marked_where_recorded_runs_stand_in(
    case: Case, fake: Fake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(case, fake)
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "empty"))
    found = campaign.comparisons(finish(case, tmp_path / "one"))
    checks = [(item.check, item.left.source, item.right.source, item.verdict) for item in found]
    assert checks == [
        ("equivalence", "native", "fake", AGREE),
        ("equivalence_curve", "native", "fake", AGREE),
        ("at_least", "native", "bound", AGREE),
        ("at_least", "fake", "bound", AGREE),
        ("recorded", "fake as recorded", "fake", AGREE),
    ]
    assert [(item.left.recorded, item.right.recorded) for item in found] == [
        (False, True), (False, True), (False, False), (True, False), (True, False),
    ]  # fmt: skip
    live = campaign.comparisons(finish(case, tmp_path / "two", live=True))
    assert not any(item.left.recorded or item.right.recorded for item in live if item.check != "recorded")


def test_a_code_that_repeats_its_recorded_run_otherwise_differs(case: Case, fake: Fake, tmp_path: Path) -> None:
    record(case, fake)
    fake.shift = 1e-9
    found = campaign.comparisons(finish(case, tmp_path / "one", live=True))
    assert {item.check: item.verdict for item in found if item.right.source == "fake"} == {
        "equivalence": AGREE,
        "equivalence_curve": AGREE,
        "recorded": DIFFER,
    }


def test_lists_are_measured_and_not_recorded(fake: Fake, tmp_path: Path) -> None:
    profiled = load(BED + PROFILE, tmp_path)
    record(profiled, fake)
    stored = list((tmp_path / "reference").rglob("measured.json"))
    assert len(stored) == 3
    for path in stored:
        assert set(measured.read(path.parent).series) == {"packing_fraction", "gain"}


def test_lists_that_are_not_recorded_do_not_part_an_ensemble(
    fake: Fake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    profiled = load(BED + PROFILE, tmp_path)
    record(profiled, fake)
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "empty"))
    found = finish(profiled, tmp_path / "one")
    assert origins(found) == ["live", "recorded", "recorded"]
    assert {item.verdict for item in campaign.comparisons(found)} == {AGREE}


def test_recorded_runs_of_another_version_do_not_stand_in(
    case: Case, fake: Fake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(case, fake)
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "empty"))
    fake.code = Code("fake", "2", "fake 2-1")
    assert origins(finish(case, tmp_path / "one")) == ["live"] * 3


def test_other_checks_beside_those_of_ensembles_are_refused(tmp_path: Path) -> None:
    text = (
        BED
        + """
[[gates]]
quantity = "position_history"
check = "mirror"
scale = "peak"
bound = 1e-9
bound_source = "the tests"
"""
    )
    with pytest.raises(CaseError, match=r"gates\.3\.check = mirror: the gates of a case judge either ensembles"):
        load(text, tmp_path)


def test_a_damaged_baseline_is_one_line_and_exit_code_2(case: Case, fake: Fake, tmp_path: Path) -> None:
    record(case, fake)
    (path,) = baseline.folder("small-bed").glob("*.json")
    path.write_text("{")
    done = CliRunner().invoke(
        main, ["run", str(case.path), "--codes", "fake", "--out", str(tmp_path / "out")], catch_exceptions=False
    )
    assert done.exit_code == BAD_INPUT


def test_a_recorded_run_of_another_schema_version_is_refused(
    case: Case, fake: Fake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(case, fake)
    for path in (tmp_path / "reference").rglob("measured.json"):
        path.write_text(path.read_text().replace('"schema": 1,\n "stages"', '"schema": 7,\n "stages"'))
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "empty"))
    done = call("run", str(case.path), "--codes", "fake", "--out", str(tmp_path / "out"))
    assert done.exit_code == BAD_INPUT
    assert "schema 7, this version reads schema 1" in done.output
    assert done.output.count("error:") == 1


def call(*arguments: str) -> Result:
    return CliRunner().invoke(main, list(arguments))


def test_one_seed_of_each_ensemble_is_not_comparable_and_says_so(case: Case, fake: Fake, tmp_path: Path) -> None:
    out = tmp_path / "out"
    call("run", str(case.path), "--codes", "fake", "--seeds", "1", "--out", str(out))
    assert fake.ran == [1]
    found = {item["check"]: item["verdict"] for item in json.loads((out / "verdicts.json").read_text())}
    assert found == {
        "equivalence": "not-comparable(an ensemble of one has no scatter)",
        "equivalence_curve": "not-comparable(an ensemble of one has no scatter)",
        "at_least": AGREE,
    }


def test_a_kept_campaign_of_a_bed_is_compared_anew(fake: Fake, tmp_path: Path) -> None:
    case, out = load(BED + PROFILE, tmp_path), tmp_path / "out"
    done = call("run", str(case.path), "--codes", "fake", "--out", str(out))
    assert done.exit_code == 0, done.output
    first = json.loads((out / "verdicts.json").read_text())
    assert [item["verdict"] for item in first] == [AGREE] * 4
    assert not list(out.rglob("record.json")), "trajectories of beds are not kept"
    assert call("compare", str(out)).exit_code == 0
    assert json.loads((out / "verdicts.json").read_text()) == first
    assert fake.ran == SEEDS
    page = (out / "report" / "index.html").read_text()
    for title in ("packing fraction, mean of 3 seeds", "profile, first seed", "packing fraction of every seed"):
        assert title in page


def test_nothing_changed_since_a_baseline_of_the_same_runs(case: Case, fake: Fake, tmp_path: Path) -> None:
    record(case, fake)
    finished = finish(case, tmp_path / "one")
    (changed,), over_time = regression.changes([case], finished.results, ("fake",))
    assert {change.kind for change in changed.changes} == {IDENTICAL}
    assert {(change.source, change.measure.observable) for change in changed.changes} == {
        (source, name) for source in ("native", "fake") for name in ("packing_fraction",)
    }
    assert [trend.measure.observable for trend in over_time] == ["packing_fraction"]


def test_the_report_shows_what_changed_since_the_baseline(case: Case, fake: Fake, tmp_path: Path) -> None:
    record(case, fake)
    fake.shift, out = 1e-3, tmp_path / "out"
    finished = finish(case, tmp_path / "one", live=True)
    (changed,), _ = regression.changes([case], finished.results, ("fake",))
    kinds = {(change.source, change.measure.observable): change.kind for change in changed.changes}
    assert kinds["fake", "packing_fraction"] == BEYOND
    assert kinds["native", "packing_fraction"] == IDENTICAL
    page, _ = campaign.write(finished, out, pdf=False)
    text = page.read_text()
    section = text[text.index('<section id="changes">') : text.index('<section id="left-out">')]
    for words in ("small-bed", "changed beyond scatter", "1 identical"):
        assert words in section


def test_a_case_without_a_baseline_is_held_against_none(case: Case, fake: Fake, tmp_path: Path) -> None:
    finished = finish(case, tmp_path / "one")
    assert fake.ran == SEEDS
    assert regression.changes([case], finished.results, ("fake",)) == ([], [])


def test_cases_without_ensembles_have_no_baseline(fake: Fake, tmp_path: Path) -> None:
    slide = load(SLIDE, tmp_path)
    results: runs.Results = {variant.scenes[0].name: {} for variant in slide.variants}
    assert regression.present(slide, results, ("fake",)) is None
    assert regression.record([slide], results, ("fake",)) == []
    assert fake.ran == []


def test_two_baselines_of_different_cases_are_refused(case: Case, fake: Fake, tmp_path: Path) -> None:
    record(case, fake)
    (path,) = baseline.folder("small-bed").glob("*.json")
    one = baseline.read(path)
    with pytest.raises(BaselineError, match=r"baselines of different cases: small-bed .* and other-bed"):
        compare_baselines(one, replace(one, case="other-bed"))
    # A file in the wrong folder is found where the case is compared.
    baseline.write(replace(one, case="other-bed"), path)
    finished = finish(case, tmp_path / "one")
    with pytest.raises(BaselineError, match=r"baselines of different cases: other-bed .* and small-bed"):
        regression.changes([case], finished.results, ("fake",))


def test_what_is_recorded_anew_replaces_what_no_deck_asks_for(case: Case, fake: Fake, tmp_path: Path) -> None:
    record(case, fake)
    assert recording.refresh([case], ignore) == (3, 0)
    other = load(BED, tmp_path, "particles.0.velocity=0.02")
    assert recording.refresh([other], ignore) == (3, 3)
    fake.code = None
    with pytest.raises(CaseError, match="no external code is installed"):
        recording.refresh([other], ignore)


def test_a_version_that_is_not_proved_is_not_comparable(case: Case, fake: Fake, tmp_path: Path) -> None:
    fake.code = Code("fake", "3", "fake 3-1")
    found = campaign.comparisons(finish(case, tmp_path / "one"))
    assert {item.verdict for item in found if "fake" in (item.left.source, item.right.source)} == {
        "not-comparable(fake 3 is installed, the translation is proved for 1, 2)"
    }
    assert fake.ran == []


CROWD = (
    HEAD.format(name="crowd")
    + """
[[particles]]
kind = "random"
material = "glass"
count = 40
radius = { kind = "equal", value = "5 mm" }
region = [[0, 0, "6 mm"], ["24 mm", "24 mm", "30 mm"]]
velocity = 0

[time]
step = { kind = "fixed", value = "50 us" }

[[stages]]
name = "fall"
end = { kind = "duration", value = "10 ms" }

[ensemble]
seeds = [1]
"""
)


@pytest.mark.parametrize("command", ["run", "deck"])
def test_a_box_that_cannot_hold_its_particles_is_refused(command: str, tmp_path: Path) -> None:
    path = tmp_path / "crowd.toml"
    path.write_text(CROWD)
    extra = ["--code", "lammps"] if command == "deck" else []
    done = call(command, str(path), *extra, "--out", str(tmp_path / "out"))
    assert done.exit_code == BAD_INPUT
    assert re.search(r"crowd\.toml:\d+.*: particles\.0\.count = 40: ", done.output), done.output
    assert len(done.output.strip().splitlines()) == 1
    assert not (tmp_path / "out").exists()
