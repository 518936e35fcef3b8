"""The native discrete element engine and the case schema."""

import os
from collections.abc import Sequence
from pathlib import Path

__version__: str
OBSERVABLES: str
"""Hash of the functions that measure records."""

def load_case(path: str | Path, overrides: Sequence[str] = ...) -> str:
    """Reads, checks and expands a case file: JSON with the keys `case`, `variants` and `scenes`."""

def read_case(path: str | Path) -> str:
    """Reads and checks a case file without asking whether this build can run it: JSON of the case."""

def schema() -> str:
    """The JSON schema of the case file."""

def run_scene(scene: str, out: str | Path, threads: int = ...) -> None:
    """Runs a scene given as JSON and writes its record into the folder `out`."""

def main(arguments: Sequence[str | os.PathLike[str]]) -> int:
    """Runs the command line `crossgrain ARGUMENTS` and returns its exit code."""
