"""The native discrete element engine and the case schema."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str
OBSERVABLES: str
"""Hash of the functions that measure records."""

def load_case(path: str | Path, overrides: Sequence[str] = ..., variant: str | None = ...) -> str:
    """Reads, checks and expands a case file: JSON with the keys `case`, `variants` and `scenes`.

    `overrides` are `key=value`, with `start.` before keys of the case that it starts from; `variant` keeps one only.
    Raises `ValueError` with file, key, value and what is allowed.
    """

def read_case(path: str | Path) -> str:
    """Reads and checks a case file without asking whether this build can run it: JSON of the case."""

def schema() -> str:
    """The JSON schema of the case file."""

def run_scene(
    scene: str,
    out: str | Path,
    threads: int = ...,
    states: str | Path | None = ...,
    save_at: Sequence[int] = ...,
) -> None:
    """Runs a scene given as JSON and writes its record into the folder `out`.

    States from which scenes start are taken from the folder `states` and saved there; so are those of this run at the
    steps `save_at`. Raises `ValueError` where the scene, a state or a file does not do.
    """

def sintering_contact(
    law: str, overlaps: NDArray[np.float64], loading_stiffness: NDArray[np.float64], cohesive: bool = ...
) -> dict[str, NDArray[np.float64]]:
    """Drives one contact of the sintering law, `[model.normal]` of a case as JSON, through overlaps (T,) [m].

    `loading_stiffness` (T,) [N/m] is k1(T,t) at each of them, above 0 and at most k1. Returns arrays (T,): `force` [N]
    without the dashpot, `largest_overlap` [m], unloading `stiffness` [N/m] and plastic `offset` [m]. Equations 4 to 13
    of Luding, Manetsberger, Mueller, J. Mech. Phys. Solids 53 (2005) 455.

    Raises `ValueError` for another law, lengths that differ and stiffnesses that are not allowed.
    """

def sintering_stiffness(
    law: str,
    temperatures: NDArray[np.float64],
    relaxation_times: NDArray[np.float64],
    dt: NDArray[np.float64],
) -> NDArray[np.float64]:
    """k1(T,t) (T,) [N/m] at the end of steps `dt` (T,) [s], from that of the first temperature on.

    One temperature (T,) [K] and one relaxation time (T,) [s] for each step. Equations 10 and 12 of the same paper.

    Raises `ValueError` for another law and for lengths that differ.
    """

def measure(observables: str, context: str, columns: dict[str, Any]) -> dict[str, NDArray[np.float64]]:
    """Measures the samples of a record of any code: an array (T,) or (T, K) in SI units for every observable.

    `observables` is a JSON list of `{"name": ..., "measure": {"kind": ...}}`, as in a case; other keys do not matter.
    `context` is a JSON object with `radius` [m], `mass` [kg], `moment_of_inertia` [kg m2] and optionally `material` of
    the N particles, `gravity` [m/s2], `domain` and the B `bodies` as in a scene, and optionally `friction`: a list of
    `{"between": [material, material], "value": ...}`, and `disks`: true for disks as high as the domain along y.
    `columns` are those of a record (docs/formats.md): `time` (T,) and `position` (T, N, 3) always, the others where an
    observable needs them; `body_point` (T, B, 3) [m] where bodies move and `radius` (T, N) [m] where radii change.
    Values that are not defined are NaN.

    Raises `ValueError` for JSON, shapes, values and columns that do not fit, and for an observable that needs a column
    that is not there.
    """

def measure_units(observables: str) -> dict[str, str]:
    """SI units of observables by name; `-` for a number. `observables` as for `measure`."""

def run(scene: str, threads: int = ..., states: str | Path | None = ...) -> tuple[str, dict[str, NDArray[Any]]]:
    """Runs a scene given as JSON; returns the header of its record as JSON, and its columns (docs/formats.md).

    States from which scenes start are taken from the folder `states` and saved there, for this engine only.
    """

def main(arguments: Sequence[str | os.PathLike[str]]) -> int:
    """Runs the command line `crossgrain ARGUMENTS` and returns its exit code."""
