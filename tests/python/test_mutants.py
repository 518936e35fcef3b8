"""Planted faults: each file of tests/mutants breaks one thing, and a named verdict must turn red for it."""

from __future__ import annotations

import dataclasses
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from cross_check import toml_file
from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import Deck
from cross_check.cli import UNEXPECTED, main
from cross_check.compare.outcome import mirror_name
from cross_check.scene import Scene

ROOT = Path(__file__).parents[2]
MUTANTS = {path.stem: toml_file.read(path) for path in sorted((ROOT / "tests" / "mutants").glob("*.toml"))}
BUILD = ROOT / "target" / "mutants"

# The module that a faulty engine has besides.
PLANTED = """//! The fault that the environment names.

/// Whether this fault is planted.
pub fn planted(name: &str) -> bool {
    static NAME: std::sync::OnceLock<Option<String>> = std::sync::OnceLock::new();
    NAME.get_or_init(|| std::env::var("CROSSGRAIN_FAULT").ok()).as_deref() == Some(name)
}
"""

engine_mutants = [name for name, mutant in MUTANTS.items() if "file" in mutant]
deck_mutants = [name for name, mutant in MUTANTS.items() if "code" in mutant]


def stands_once(text: str, mutant: dict[str, Any]) -> None:
    """What is to be broken must stand there exactly once."""
    assert text.count(mutant["find"]) == 1, f"{mutant['find']!r} stands {text.count(mutant['find'])} times"


def assert_red(folder: Path, wanted: dict[str, str]) -> None:
    """The named verdict is there and is not the expected one."""
    verdicts = json.loads((folder / "verdicts.json").read_text())
    named = [
        item
        for item in verdicts
        if item["case"].partition("/")[0] == wanted["case"]
        and item["quantity"] == wanted["quantity"]
        and item["left"]["source"] == wanted["left"]
        and item["right"]["source"] == wanted["right"]
    ]
    assert named
    assert any(item["verdict"] == "differ" and item["expected"] != "differ" for item in named)


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The command `crossgrain` of an engine that holds all faults, each asleep until the environment names it.

    An expression E that a fault replaces by F becomes `if planted("name") { F } else { E }`: one build serves them all.
    """
    folder = tmp_path_factory.mktemp("engine")
    for name in ("Cargo.toml", "Cargo.lock", "README.md", "benches", "build.rs"):
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name)
        elif source.is_file():
            shutil.copy2(source, folder / name)
    shutil.copytree(ROOT / "src", folder / "src")
    for name in engine_mutants:
        mutant = MUTANTS[name]
        path = folder / mutant["file"]
        text = path.read_text()
        stands_once(text, mutant)
        choice = f'(if crate::planted::planted("{name}") {{ {mutant["replace"]} }} else {{ {mutant["find"]} }})'
        path.write_text(text.replace(mutant["find"], choice))
    (folder / "src" / "planted.rs").write_text(PLANTED)
    library = folder / "src" / "lib.rs"
    library.write_text(library.read_text() + "pub mod planted;\n")
    release = ROOT / "target" / "release"
    if release.is_dir() and not BUILD.is_dir():
        BUILD.mkdir()
        shutil.copytree(
            release, BUILD / "release", copy_function=os.link, ignore=shutil.ignore_patterns("*crossgrain*")
        )
    # Built quickly: what the runs take is little.
    quickly = "profile.release.package.crossgrain.opt-level=1"
    command = ["cargo", "build", "--release", "--quiet", "--bin", "crossgrain", "--config", quickly]
    environment = os.environ | {"CARGO_TARGET_DIR": str(BUILD), "RUSTFLAGS": os.environ.get("RUSTFLAGS", "")}
    subprocess.run(command, cwd=folder, env=environment, check=True, timeout=1800)
    return BUILD / "release" / "crossgrain"


@pytest.mark.skipif(shutil.which("cargo") is None, reason="cargo is not installed")
@pytest.mark.parametrize("name", engine_mutants)
def test_a_fault_of_the_engine_turns_its_verdict_red(name: str, program: Path, tmp_path: Path) -> None:
    wanted = MUTANTS[name]["must_turn_red"]
    codes = [code for code in ADAPTERS if mirror_name(code) in (wanted["left"], wanted["right"])]
    command = [str(Path(sys.executable).with_name("cross-check")), "run", wanted["case"], "--no-figures"]
    command += ["--codes", ",".join(codes), "--out", str(tmp_path / "out")]
    environment = os.environ | {
        "CROSSGRAIN_NATIVE": str(program),
        "CROSSGRAIN_CACHE": str(tmp_path / "cache"),
        "CROSSGRAIN_FAULT": name,
    }
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == UNEXPECTED, done.stderr
    assert_red(tmp_path / "out", wanted)


@pytest.mark.parametrize("name", deck_mutants)
def test_a_fault_of_a_deck_turns_its_verdict_red(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mutant = MUTANTS[name]
    adapter = ADAPTERS[mutant["code"]]
    if adapter.installed() is None:
        pytest.skip(f"{mutant['code']} is not installed")
    translate, touched = adapter.deck, list[str]()

    def faulty(scene: Scene) -> Deck:
        deck = translate(scene)
        text = deck.files[deck.main]
        if mutant["find"] in text:
            touched.append(scene.name)
            stands_once(text, mutant)
            text = text.replace(mutant["find"], mutant["replace"])
        return dataclasses.replace(deck, files=deck.files | {deck.main: text})

    monkeypatch.setattr(adapter, "deck", faulty)
    monkeypatch.setenv("CROSSGRAIN_CACHE", str(tmp_path / "cache"))
    case = mutant["must_turn_red"]["case"]
    command = ["run", case, "--no-figures", "--codes", mutant["code"], "--out", str(tmp_path / "out")]
    done = CliRunner().invoke(main, command)
    assert touched
    assert done.exit_code == UNEXPECTED, done.output
    assert_red(tmp_path / "out", mutant["must_turn_red"])
