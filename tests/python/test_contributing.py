from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner
from test_docs import ROOT, blocks

from cross_check.cli import main

PAGE = ROOT / "CONTRIBUTING.md"
ENDINGS = (".md", ".py", ".rs", ".toml", ".j2")


def paths() -> list[str]:
    """What stands in backticks on the page and is the path of a file or a folder."""
    spans = re.findall(r"`([^`\s]+)`", re.sub(r"^ *```.*?^ *```", "", PAGE.read_text(), flags=re.MULTILINE | re.DOTALL))
    return sorted({span for span in spans if "/" in span or span.endswith(ENDINGS)})


def test_the_page_names_paths() -> None:
    assert len(paths()) > 20


@pytest.mark.parametrize("path", paths())
def test_path_exists(path: str) -> None:
    if path.startswith(".venv/"):
        return
    chosen, _, _ = path.partition("NAME")
    assert (ROOT / chosen).exists()


def recipe(folder: Path) -> Path:
    (text,) = blocks(PAGE, "toml")
    path = folder / "my_case.toml"
    path.write_text(text)
    return path


@pytest.mark.parametrize("codes", ["", "lammps"])
def test_the_recipe_for_a_case_works(codes: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if codes == "lammps" and shutil.which("lmp") is None:
        pytest.skip("lammps is not installed")
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "cache"))
    out = tmp_path / "out"
    result = CliRunner().invoke(main, ["run", str(recipe(tmp_path)), "--codes", codes, "--out", str(out)])
    assert result.exit_code == 0, result.output
    verdicts = json.loads((out / "verdicts.json").read_text())
    assert len(verdicts) == (3 if codes else 1)
    assert {item["verdict"] for item in verdicts} == {"agree"}
    assert (out / "report" / "index.html").is_file()


def test_the_page_names_every_adapter_folder_as_an_example_or_a_neighbour() -> None:
    folders = {path.parent.name for path in (ROOT / "cross_check" / "adapters").glob("*/translate.py")}
    assert {"lammps", "liggghts", "yade"} <= folders
    for name in ("__init__.py", "translate.py", "run.py", "mirror.py"):
        assert [folder for folder in folders if not (ROOT / "cross_check/adapters" / folder / name).is_file()] == []
