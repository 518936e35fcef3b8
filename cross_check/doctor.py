"""What is present, what is missing, and how to get it."""

from __future__ import annotations

import importlib.metadata
import shutil
import sys
from dataclasses import asdict, dataclass
from typing import Any

from cross_check import engine
from cross_check.adapters import ADAPTERS

PYTHON_PARTS = ("numpy", "scipy", "matplotlib", "jinja2", "rich", "click", "platformdirs")


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
    mpi = shutil.which("mpirun")
    parts.append(Part("mpi", mpi is not None, mpi or "", "" if mpi else "not needed: every run uses one process"))
    parts.append(Part("python", True, sys.version.split()[0]))
    for name in PYTHON_PARTS:
        try:
            parts.append(Part(name, True, importlib.metadata.version(name)))
        except importlib.metadata.PackageNotFoundError:
            parts.append(Part(name, False, "", f"pip install {name}"))
    return parts
