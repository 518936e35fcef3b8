"""The native engine as the harness uses it: cases read, scenes run."""

from __future__ import annotations

import functools
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

import crossgrain
from cross_check.record import Code, Header, RecordError, RunRecord, read
from cross_check.scene import Scene, from_json

#: Names a program to read cases and run scenes with, in place of the module: engines with planted faults are such.
PROGRAM_VARIABLE = "CROSSGRAIN_NATIVE"
# Where the parts of an expanded case name their variant.
VARIANT_KEYS = {"variants": "name", "scenes": "variant"}


class CaseError(Exception):
    """A case that cannot be read or run: the message names file, line, key, value and what is allowed."""


@dataclass(frozen=True)
class Gate:
    """One comparison of one quantity, as the case states it (src/case/schema.rs)."""

    quantity: str
    check: str
    reference: str | None
    scale: str
    bound: float
    bound_source: str
    order: tuple[float, float] | None
    matched: Matched | None = None
    full_only: bool = False


@dataclass(frozen=True)
class MatchedSide:
    """A code at a point of a sweep."""

    code: str
    point: str


@dataclass(frozen=True)
class Matched:
    """Two codes under different laws that a closed form makes alike."""

    left: MatchedSide
    right: MatchedSide


@dataclass(frozen=True)
class Point:
    """Where a variant stands on one axis of the sweep."""

    axis: str
    label: str
    at: float | None


@dataclass(frozen=True)
class Variant:
    """A point of the sweep, and one seed of its ensemble; `scenes` are its refinements, coarsest first.

    `full_only`: only the full form of a suite runs it.
    """

    name: str
    points: tuple[Point, ...]
    scenes: tuple[Scene, ...]
    full_only: bool = False
    gates: tuple[Gate, ...] = ()

    @property
    def member(self) -> str:
        """`variant/seed=1`: the name of the variant and the seed, without the parts that the case lacks."""
        return self.scenes[0].member


@dataclass(frozen=True)
class Case:
    """A case with its variants."""

    path: Path
    name: str
    question: str
    level: str
    source: str
    suites: tuple[str, ...]
    gates: tuple[Gate, ...]
    variants: tuple[Variant, ...]


def _gate(raw: dict[str, Any]) -> Gate:
    typed, order = dict(raw), raw["order"]
    typed["order"] = None if order is None else (float(order[0]), float(order[1]))
    if raw["matched"] is not None:
        typed["matched"] = Matched(MatchedSide(**raw["matched"]["left"]), MatchedSide(**raw["matched"]["right"]))
    return Gate(**typed)


def _scenes(path: Path, overrides: list[str], variant: str | None) -> dict[str, Any]:
    """The case with its variants and scenes as the engine makes them. Raises CaseError."""
    program = os.environ.get(PROGRAM_VARIABLE)
    if program is None:
        try:
            return json.loads(crossgrain.load_case(path, overrides, variant))
        except ValueError as error:
            raise CaseError(str(error)) from error
    command = [program, "scenes", str(path), *(word for item in overrides for word in ("--set", item))]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)  # noqa: S603
    if done.returncode != 0:
        raise CaseError(done.stderr.strip().removeprefix("error: "))
    found = json.loads(done.stdout)
    if variant is None:
        return found
    names = [item["name"] for item in found["variants"]]
    if variant not in names:
        raise CaseError(f"{path}: no variant {variant} (known: {' '.join(names)})")
    kept = {key: [item for item in found[key] if item[name] == variant] for key, name in VARIANT_KEYS.items()}
    return {**found, **kept}


def case_file(name: str) -> str:
    """The name of the file in which the engine looks for a case that another one starts from."""
    return name.replace("-", "_") + ".toml"


def load_case(path: Path, overrides: list[str] | None = None, variant: str | None = None) -> Case:
    """Reads, checks and expands a case file, or one variant of it. Raises CaseError.

    `overrides` are `key=value`; those that begin with `start.` are for the case that it starts from.
    """
    raw = _scenes(path, overrides or [], variant)
    members: dict[str, dict[int | None, list[Scene]]] = {}
    for item in raw["scenes"]:
        members.setdefault(item["variant"], {}).setdefault(item["seed"], []).append(from_json(item))
    variants = tuple(
        Variant(
            item["name"],
            tuple(Point(**point) for point in item["points"]),
            tuple(scenes),
            item["full_only"],
            tuple(_gate(gate) for gate in item["gates"]),
        )
        for item in raw["variants"]
        for scenes in members[item["name"]].values()
    )
    case = raw["case"]
    return Case(
        path=path,
        name=case["name"],
        question=case["question"],
        level=case["level"],
        source=case["source"],
        suites=tuple(case["suites"]),
        gates=tuple(_gate(gate) for gate in case["gates"]),
        variants=variants,
    )


def version() -> str:
    """Version of the native engine."""
    return crossgrain.__version__


@functools.cache
def build() -> str:
    """Hash of the engine's machine code: a rebuilt engine never meets runs of another one in the cache."""
    program = os.environ.get(PROGRAM_VARIABLE)
    path = Path(program) if program else next(Path(crossgrain.__file__).parent.glob("crossgrain*.so"))
    return hashlib.blake2b(path.read_bytes(), digest_size=16).hexdigest()


def run(scene: Scene, folder: Path | None = None, threads: int = 1, states: Path | None = None) -> RunRecord:
    """Runs a scene and returns its record, which is also written into `folder` if there is one.

    States from which scenes start are taken from the folder `states` and saved there; a program in place of the module
    computes them anew. Raises CaseError or RecordError.
    """
    program = os.environ.get(PROGRAM_VARIABLE)
    if program is None:
        try:
            header, columns = crossgrain.run(scene.to_json(), threads, states)
        except ValueError as error:
            raise CaseError(str(error)) from error
        record = _record(json.loads(header), columns, scene.name)
        if folder is not None:
            record.write(folder, compress=False)
        return record
    with tempfile.TemporaryDirectory() as scratch:
        path, out = Path(scratch) / "scene.json", folder or Path(scratch) / "record"
        path.write_text(scene.to_json())
        command = [program, "run-scene", str(path), "--out", str(out), "--threads", str(threads)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=3600, check=False)  # noqa: S603
        if done.returncode != 0:
            raise RecordError(f"{scene.name}: {program} failed: {done.stderr.strip()}")
        return read(out)


def _record(header: dict[str, Any], columns: dict[str, NDArray[Any]], where: str) -> RunRecord:
    """The checked record of a header and columns that the module hands over. Raises RecordError."""
    typed = dict(header)
    typed["code"] = Code(**header["code"])
    record = RunRecord(Header(**typed), columns)
    record.check(where)
    return record


def main() -> None:
    """The console script `crossgrain` of the wheel."""
    sys.exit(crossgrain.main(sys.argv[1:]))
