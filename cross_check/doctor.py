"""What is present, what is missing, and how to get it."""

from __future__ import annotations

import importlib.metadata
import os
import shutil
import subprocess
import sys
from dataclasses import asdict, dataclass
from typing import Any

from cross_check import engine
from cross_check.adapters import ADAPTERS

PYTHON_PARTS = ("numpy", "scipy", "matplotlib", "meshio", "jinja2", "rich", "click", "platformdirs")
#: Python parts that the package works without, and what each is for.
OPTIONAL_PARTS = {
    "pandas": "tables of exported CSV files, the notebook",
    "h5py": "meshes in the format XDMF",
    "nbclient": "the test that runs the notebook",
    "ipykernel": "the notebook",
    "vtk": "the tests that open exported files as ParaView does",
    "ovito": "the tests that open exported files in OVITO",
    "sphinx": "the documentation site",
    "myst-nb": "the notebook in the documentation site",
}


@dataclass(frozen=True)
class Part:
    """One part of the workplace: whether it is there, its version, and what to do where it is not as it should be."""

    name: str
    present: bool
    version: str
    advice: str = ""

    def to_dict(self) -> dict[str, Any]:
        """The JSON form."""
        return asdict(self)


def examine() -> list[Part]:
    """Looks at every part."""
    parts = [Part("native", True, f"{engine.version()} (build {engine.build()[:12]})")]
    for name, adapter in ADAPTERS.items():
        code = adapter.installed()
        if code is None:
            advice = f"on Debian: apt-get install {name}; until then recorded runs stand in for it"
            parts.append(Part(name, False, "", advice))
            continue
        proved = code.version in adapter.proved_versions
        advice = (
            "" if proved else f"the translation is proved for {', '.join(adapter.proved_versions)}; see --any-version"
        )
        parts.append(Part(name, True, f"{code.version} ({code.package})", advice))
    parts += [_mpi(), _cores(), Part("python", True, sys.version.split()[0])]
    parts += [_python_part(name, f"pip install {name}") for name in PYTHON_PARTS]
    parts += [_python_part(name, f"optional, for {use}: pip install {name}") for name, use in OPTIONAL_PARTS.items()]
    return parts


def _python_part(name: str, advice: str) -> Part:
    try:
        return Part(name, True, importlib.metadata.version(name))
    except importlib.metadata.PackageNotFoundError:
        return Part(name, False, "", advice)


def _mpi() -> Part:
    """The MPI of LIGGGHTS and LAMMPS, which run as one process each all the same."""
    program = shutil.which("mpirun")
    if program is None:
        return Part("mpi", False, "", "not needed: every run of a code is one process of one thread")
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=20, check=False)  # noqa: S603
    except (OSError, subprocess.TimeoutExpired):
        return Part("mpi", True, program)
    lines = done.stdout.splitlines()
    return Part("mpi", True, f"{lines[0].strip()} ({program})" if lines else program)


def _cores() -> Part:
    """How many cores there are, and how many of them this process may use."""
    there = os.cpu_count() or 1
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else there
    words = f"{usable} of {there}: as many runs at a time as there are, of one thread each"
    advice = "" if usable == there else f"this process may use {usable} cores only: run with --jobs {usable}"
    return Part("cores", True, words, advice)
