from __future__ import annotations

import importlib.util
import json
import re
import runpy
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import click
import pytest

import crossgrain
from cross_check import cli

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = sorted([ROOT / "README.md", ROOT / "CONTRIBUTING.md", *DOCS.glob("*.md")])
FENCE = re.compile(r"^( *)```(\w+)\n(.*?)^\1```", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"`((?:cross_check|crossgrain)(?:\.\w+)+)`")


def blocks(page: Path, language: str) -> list[str]:
    """The code blocks of a page in one language, in order."""
    found = FENCE.finditer(page.read_text())
    return [textwrap.dedent(block[3]) for block in found if block[2] == language]


def parts(page: Path) -> tuple[str, str]:
    """The case that the parts of the page of cases make, and the one of its section on beds."""
    whole = page.read_text()
    cut = whole.index("\n## Beds\n")
    found = [(block.start() < cut, textwrap.dedent(block[3])) for block in FENCE.finditer(whole) if block[2] == "toml"]
    first, second = ("\n".join(text for before, text in found if before == side) for side in (True, False))
    return first, second


def shell_lines(page: Path) -> list[str]:
    return [line for block in blocks(page, "sh") for line in block.splitlines() if line and not line.startswith("#")]


def is_whole_case(text: str) -> bool:
    return text.startswith("schema = 1") and "[[stages]]" in text


def with_blocks(language: str) -> list[Path]:
    return [page for page in PAGES if blocks(page, language)]


def by_path(page: Path) -> str:
    return str(page.relative_to(ROOT))


@pytest.fixture(autouse=True)
def apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "work"
    folder.mkdir()
    monkeypatch.chdir(folder)


@pytest.mark.parametrize("page", with_blocks("python"), ids=by_path)
def test_python_examples_run(page: Path) -> None:
    names: dict[str, Any] = {"__name__": "example"}
    for number, text in enumerate(blocks(page, "python"), start=1):
        exec(compile(text, f"{page.name}, block {number}", "exec"), names)  # noqa: S102  the project's own pages


def test_the_example_that_counts_verdicts_counts_them(tmp_path: Path) -> None:
    names: dict[str, Any] = {}
    exec(blocks(DOCS / "reading-a-report.md", "python")[0], names)  # noqa: S102  the project's own page
    verdicts = [{"verdict": "agree"}, {"verdict": "known-difference(force-cut)"}, {"verdict": "agree"}]
    (tmp_path / "verdicts.json").write_text(json.dumps(verdicts))
    assert names["count"](tmp_path) == {"agree": 2, "known-difference": 1}


@pytest.mark.parametrize("page", PAGES, ids=by_path)
def test_whole_cases_on_a_page_are_accepted(page: Path, tmp_path: Path) -> None:
    for text in filter(is_whole_case, blocks(page, "toml")):
        path = tmp_path / "case.toml"
        path.write_text(text)
        assert json.loads(crossgrain.load_case(path, []))["scenes"]


def test_the_parts_of_a_case_make_one_that_runs_as_the_page_says(tmp_path: Path) -> None:
    path = tmp_path / "bead-on-plate.toml"
    path.write_text(parts(DOCS / "cases.md")[0])
    status = run_command(["run", str(path), "--codes", "", "--out", str(tmp_path / "out")])
    assert status == 0
    verdicts = json.loads((tmp_path / "out" / "verdicts.json").read_text())
    assert [item["verdict"] for item in verdicts] == ["agree", "agree"]


@pytest.mark.parametrize("codes", ["", "lammps"])
def test_the_bed_of_the_page_of_cases_runs_and_agrees(codes: str, tmp_path: Path) -> None:
    if codes and shutil.which("lmp") is None:
        pytest.skip("lammps is not installed")
    path = tmp_path / "small-pour.toml"
    path.write_text(parts(DOCS / "cases.md")[1])
    assert run_command(["run", str(path), "--codes", codes, "--out", str(tmp_path / "out")]) == 0
    verdicts = json.loads((tmp_path / "out" / "verdicts.json").read_text())
    checks = ["equivalence", "equivalence_curve", "at_least", "at_least", "at_most", "at_most"]
    assert [item["check"] for item in verdicts] == (checks if codes else ["at_least", "at_most"])
    assert {item["verdict"] for item in verdicts} == {"agree"}
    found = crossgrain.load_case(path, [])
    assert json.loads(found)["scenes"][0]["contacts"]


def run_command(arguments: list[str]) -> int:
    """The exit code of `cross-check ARGUMENTS`."""
    try:
        cli.main(arguments, standalone_mode=False)
    except SystemExit as leaving:
        return int(leaving.code or 0)
    return 0


def test_the_error_on_the_page_of_cases_is_the_one_that_comes(tmp_path: Path) -> None:
    shown = next(text for text in blocks(DOCS / "cases.md", "text") if text.startswith("error:"))
    text, _ = parts(DOCS / "cases.md")
    path = tmp_path / "bead-on-plate.toml"
    path.write_text(text.replace("poisson = 0.22", "poisson = 0.7"))
    with pytest.raises(ValueError, match="poisson") as caught:
        crossgrain.load_case(path, [])
    said = str(caught.value).removeprefix(f"{tmp_path}/").replace(" (e=0.8)", "")  # the variant may be named
    assert shown.strip() == f"error: {said}"


def test_every_key_of_the_schema_is_documented() -> None:
    made: str = runpy.run_path(str(DOCS / "case_keys.py"))["page"]()
    assert (DOCS / "case-keys.md").read_text() == made, "stale: run .venv/bin/python docs/case_keys.py"


def test_every_quantity_check_and_closed_form_is_on_the_page_of_cases() -> None:
    from cross_check.compare.checks import CHECKS
    from cross_check.compare.quantities import QUANTITIES
    from cross_check.reference import closed_forms

    text = (DOCS / "cases.md").read_text()
    assert [name for name in (*QUANTITIES, *CHECKS, *closed_forms()) if f"`{name}`" not in text] == []


def test_every_known_difference_is_on_the_page_of_verdicts() -> None:
    from cross_check.compare.differences import known

    text = (DOCS / "verdicts.md").read_text()
    assert [name for name in known() if f"`{name}`" not in text] == []


@pytest.mark.parametrize("page", PAGES, ids=by_path)
def test_python_names_on_a_page_exist(page: Path) -> None:
    for name in NAMED.findall(page.read_text()):
        module, _, attribute = name.rpartition(".")
        assert hasattr(importlib.import_module(module), attribute), name


def test_the_example_prints_a_table_that_meets_its_closed_forms() -> None:
    table = runpy.run_path(str(ROOT / "examples" / "restitution_curve.py"))["table"]
    _, row = table([0.5], steps_per_contact=200)
    _, cut, uncut, exact_cut, exact_uncut = map(float, row.split())
    first_order = 0.01  # [-] at 200 steps per contact
    assert abs(cut - exact_cut) < first_order
    assert abs(uncut - exact_uncut) < first_order
    assert exact_cut == 0.5503


def test_the_table_of_rebounds_is_that_of_the_closed_forms() -> None:
    table = runpy.run_path(str(ROOT / "examples" / "restitution_curve.py"))
    rows = re.findall(r"^\| (0[.\d]*) \| (0[.\d]*) \| (0\.\d+) \|$", (DOCS / "physics.md").read_text(), re.MULTILINE)
    assert len(rows) == 5
    from cross_check.reference import closed_forms

    forms = closed_forms()
    for asked, uncut, cut in rows:
        scene = table["scene_of"](float(asked), 100)
        assert abs(forms["damped_impact.restitution_uncut"](scene) - float(uncut)) < 1e-4
        assert abs(forms["damped_impact.restitution_cut"](scene) - float(cut)) < 1e-4


def options_of_cross_check(command: str) -> set[str]:
    found = cli.main.commands.get(command)
    assert found is not None, f"cross-check has no command {command} (known: {', '.join(cli.main.commands)})"
    return {"--help"} | {name for option in found.params if isinstance(option, click.Option) for name in option.opts}


def options_of_crossgrain(command: str, capfd: pytest.CaptureFixture[str]) -> set[str]:
    capfd.readouterr()
    assert crossgrain.main([command, "--help"]) == 0, f"crossgrain has no command {command}"
    return set(re.findall(r"--[a-z][a-z-]*", capfd.readouterr().out))


@pytest.mark.parametrize("page", PAGES, ids=by_path)
def test_commands_and_options_on_a_page_exist(page: Path, capfd: pytest.CaptureFixture[str]) -> None:
    spans = re.findall(r"`((?:cross-check|crossgrain) [a-z][^`]*)`", page.read_text())
    for line in [*shell_lines(page), *spans]:
        program, _, rest = line.removeprefix(".venv/bin/").partition(" ")
        if program not in ("cross-check", "crossgrain"):
            files = re.findall(r"(?:\./)?((?:scripts|examples)/\S+)", line)
            assert [file for file in files if not (ROOT / file).is_file()] == [], line
            continue
        command = rest.split()[0]
        known = options_of_cross_check(command) if program == "cross-check" else options_of_crossgrain(command, capfd)
        assert {word for word in rest.split() if word.startswith("--")} <= known, line


@pytest.mark.parametrize("page", PAGES, ids=by_path)
def test_files_that_a_page_links_exist(page: Path) -> None:
    targets = re.findall(r"\]\(([^)#:]+?)(?:#[^)]*)?\)", FENCE.sub("", page.read_text()))
    assert [target for target in targets if not (page.parent / target).exists()] == []


def test_the_readme_lists_every_command() -> None:
    text = (ROOT / "README.md").read_text()
    assert [name for name in cli.main.commands if f"`cross-check {name}" not in text] == []


def test_the_site_builds_without_a_warning(tmp_path: Path) -> None:
    for module in ("sphinx", "myst_nb", "furo", "sphinx-mathjax-offline", "pandas"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed; the extra `docs` brings it")
    site, cached = tmp_path / "site", tmp_path / "doctrees"
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d", str(cached)]
    done = subprocess.run([*command, str(DOCS), str(site)], capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    page = (site / "physics.html").read_text()
    scripts = re.findall(r'<script[^>]*src="([^"]+)"', page)
    assert any("mathjax" in source for source in scripts)
    assert [source for source in scripts if "//" in source] == [], "the page asks the network for a script"
    assert (site / "_static" / "mathjax" / "tex-chtml.js").is_file()
    notebook = (site / "notebooks" / "first_bed.html").read_text()
    assert notebook.count("<img") == 2, "the notebook shows its two figures"
    assert "weight 0.0107" in notebook, "the notebook has run"
    assert re.findall(r'<(?:script|img)[^>]*src="(?:https?:)?//', notebook) == []
    shutil.rmtree(site)
