"""Bad input to `cross-check`: exit code 2 and one clear line, never a traceback."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from cross_check.cli import BAD_INPUT, main

ROOT = Path(__file__).parents[2]
GOOD = ROOT / "tests/inputs/good/free_fall.toml"
BAD = ROOT / "tests/inputs/bad"


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "cache"))


def call(*arguments: str | Path) -> Result:
    """Runs `cross-check`; an exception that it does not foresee reaches the test."""
    return CliRunner().invoke(main, [str(argument) for argument in arguments], catch_exceptions=False)


def refused(done: Result, *expected: str) -> None:
    """Exit code 2 and a last line that says everything."""
    assert done.exit_code == BAD_INPUT, done.output
    line = done.stderr.strip().splitlines()[-1]
    assert line.lower().startswith("error: "), done.stderr
    for text in expected:
        assert text in line, line
    assert "Traceback" not in done.output


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A kept campaign of one native run."""
    folder = tmp_path_factory.mktemp("kept")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CROSSGRAIN_CACHE", str(folder / "cache"))
        done = call("run", "free-fall", "--codes", "", "--out", folder / "campaign")
    assert done.exit_code == 0, done.output
    return folder / "campaign"


@pytest.fixture
def campaign(kept: Path, tmp_path: Path) -> Path:
    """A copy of it to damage."""
    return Path(shutil.copytree(kept, tmp_path / "campaign"))


def record(campaign: Path) -> Path:
    """The folder of its only record."""
    return next(campaign.glob("runs/**/record.json")).parent


@pytest.mark.parametrize("command", ["run", "deck"])
@pytest.mark.parametrize(
    ("what", "expected"),
    [
        ("there-is-none.toml", ["there-is-none.toml", "No such file"]),
        ("no-such-suite", ["no-such-suite", "no such suite, case or file", "standard", "damped-pair"]),
        (str(BAD / "wrong_unit.toml"), ["wrong_unit.toml:20", "young", "`10 mm`", "`Pa`"]),
        (str(BAD / "empty.toml"), ["empty.toml", "the file is empty"]),
        (str(BAD / "not_utf8.toml"), ["not_utf8.toml:2", "not UTF-8"]),
        (str(BAD / "truncated.toml"), ["truncated.toml:18"]),
        (str(BAD / "overlap_at_the_start.toml"), ["particles.1.position", "allow_initial_overlap"]),
        (str(ROOT / "docs/sketches/silo.toml"), ["stages.0.end.kind = at_rest", "this version computes only"]),
    ],
)
def test_a_case_that_is_none_is_refused(command: str, what: str, expected: list[str], tmp_path: Path) -> None:
    extra = ["--code", "lammps"] if command == "deck" else []
    refused(call(command, what, *extra, "--out", tmp_path / "out"), *expected)
    assert not (tmp_path / "out").exists()


def test_an_unknown_code_is_refused(tmp_path: Path) -> None:
    refused(call("run", GOOD, "--codes", "lammps,edem", "--out", tmp_path / "out"), "edem", "liggghts, yade, lammps")
    refused(call("deck", GOOD, "--code", "edem", "--out", tmp_path / "out"), "edem", "lammps")


def test_a_malformed_override_is_refused(tmp_path: Path) -> None:
    deck = ["deck", GOOD, "--code", "lammps", "--out", tmp_path / "out", "--set"]
    refused(call(*deck, "nonsense"), "nonsense", "key=value")
    refused(call(*deck, "materials.0.poisson=0.9"), "materials.0.poisson = 0.9", "between -1 and 0.5")


def test_an_output_folder_that_is_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("")
    refused(call("run", "free-fall", "--codes", "", "--out", tmp_path / "out"), "out")
    refused(call("deck", GOOD, "--code", "lammps", "--out", tmp_path / "out"), "out")


@pytest.mark.parametrize("command", ["compare", "report"])
def test_a_folder_without_a_campaign_is_refused(command: str, tmp_path: Path) -> None:
    refused(call(command, tmp_path / "nowhere"), "nowhere", "not a kept campaign")
    refused(call(command, tmp_path), "campaign.json", "not a kept campaign")


@pytest.mark.parametrize("command", ["compare", "report"])
@pytest.mark.parametrize("text", ["", "{", "{}", '{"schema": 99}'])
def test_an_index_that_is_none_is_refused(command: str, text: str, campaign: Path) -> None:
    (campaign / "campaign.json").write_text(text)
    refused(call(command, campaign), "campaign.json")


@pytest.mark.parametrize("text", ["[]", '{"schema": 1}', '{"schema": 1, "cases": [3]}'])
def test_an_index_without_its_keys_is_refused(text: str, campaign: Path) -> None:
    (campaign / "campaign.json").write_text(text)
    refused(call("compare", campaign), "campaign.json", "not a kept campaign")


@pytest.mark.parametrize("command", ["compare", "report"])
def test_a_truncated_record_is_refused(command: str, campaign: Path) -> None:
    columns = record(campaign) / "columns.npz"
    whole = columns.read_bytes()
    for length in (0, len(whole) // 2, len(whole) - 10):
        columns.write_bytes(whole[:length])
        refused(call(command, campaign), str(record(campaign)), "not a readable run record")
    columns.unlink()
    refused(call(command, campaign), "columns.npz", "no such file")


def test_a_record_of_another_schema_is_refused(campaign: Path) -> None:
    path = record(campaign) / "record.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"schema": 7}))
    refused(call("compare", campaign), "record.json", "schema 7", "reads schema 1")


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"schema": 1}'])
def test_a_header_that_is_none_is_refused(text: str, campaign: Path) -> None:
    (record(campaign) / "record.json").write_text(text)
    refused(call("compare", campaign), str(record(campaign)))


def test_a_record_with_nan_is_refused(campaign: Path) -> None:
    path = record(campaign) / "columns.npz"
    with np.load(path) as data:
        columns = {name: data[name] for name in data.files}
    columns["position"][3, 0, 2] = np.nan
    np.savez(path, allow_pickle=False, **columns)
    step = int(columns["step"][3])
    refused(call("compare", campaign), "column position is not a finite number", f"step {step}")


def test_a_record_that_lacks_a_column_is_refused(campaign: Path) -> None:
    path = record(campaign) / "columns.npz"
    with np.load(path) as data:
        columns = {name: data[name] for name in data.files if name != "force"}
    np.savez(path, allow_pickle=False, **columns)
    refused(call("compare", campaign), "column force is missing")


def test_a_case_that_is_gone_is_refused(campaign: Path) -> None:
    index = json.loads((campaign / "campaign.json").read_text())
    index["cases"] = ["/there/is/none.toml"]
    (campaign / "campaign.json").write_text(json.dumps(index))
    refused(call("compare", campaign), "/there/is/none.toml", "No such file")
