"""The published JSON schema accepts every case and every sketch, and refuses what is no case."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator, ValidationError

import crossgrain

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
SCHEMA: dict[str, Any] = json.loads(crossgrain.schema())
CASES = sorted(ROOT.glob("cross_check/cases/*.toml")) + sorted(ROOT.glob("tests/inputs/good/*.toml"))
SKETCHES = sorted(ROOT.glob("docs/sketches/*.toml"))
# What is wrong in these files stands in the schema itself, not in the physics or in a unit.
STRUCTURAL = ["unknown_key", "unknown_key_in_a_law_without_values", "unknown_law", "missing_key", "wrong_type"]


def problems(path: Path) -> list[str]:
    """What the schema says against a case file, one line each."""
    case = tomllib.loads(path.read_text())
    found: Iterable[ValidationError] = Draft202012Validator(SCHEMA).iter_errors(case)  # pyright: ignore[reportUnknownMemberType]
    return [f"{error.json_path}: {error.message[:200]}" for error in found]


def test_the_schema_is_a_schema() -> None:
    Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("path", CASES + SKETCHES, ids=lambda path: path.stem)
def test_the_schema_accepts_every_case_and_sketch(path: Path) -> None:
    assert problems(path) == []


def test_sketches_are_read_as_stated() -> None:
    assert len(SKETCHES) == 5
    for path in SKETCHES:
        assert json.loads(crossgrain.read_case(path))["name"].startswith("sketch-")


@pytest.mark.parametrize("name", STRUCTURAL)
def test_the_schema_refuses_what_is_no_case(name: str) -> None:
    assert problems(ROOT / f"tests/inputs/bad/{name}.toml") != []


def test_the_published_schema_is_that_of_the_engine() -> None:
    published = json.loads((ROOT / "docs/case.schema.json").read_text())
    assert published == SCHEMA, "run `crossgrain schema > docs/case.schema.json`"
