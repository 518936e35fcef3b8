"""Which external program is here, its version in its own words, and the package that brought it."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path

from cross_check.adapters.runner import environment
from cross_check.record import Code

# Longest time [s] that a program may take to say its version; YADE takes 2 s on an idle machine.
PATIENCE = 60.0


def executable(variable: str, program: str) -> str | None:
    """Absolute path of `program`: the one named by the environment variable, else the first on PATH."""
    found = shutil.which(os.environ.get(variable) or program)
    return None if found is None else str(Path(found).absolute())


def installed(name: str, variable: str, program: str, argument: str, pattern: str) -> Code | None:
    """The installed program, or None; its version is group 1 of `pattern` in what it prints when given `argument`."""
    path = executable(variable, program)
    return None if path is None else _describe(name, path, argument, pattern)


@cache
def _describe(name: str, path: str, argument: str, pattern: str) -> Code:
    match = re.search(pattern, _output([path, argument]))
    return Code(name, match.group(1).strip() if match else "unknown", _package(path))


def _package(path: str) -> str:
    """`name version` of the Debian package that owns `path`, or `unknown`."""
    for candidate in dict.fromkeys((path, str(Path(path).resolve()))):
        owner = re.match(r"([a-z0-9+.-]+)(?::[a-z0-9]+)?: ", _output(["dpkg-query", "-S", candidate]))
        if owner:
            return _output(["dpkg-query", "-W", "-f", "${Package} ${Version}", owner.group(1)]).strip() or "unknown"
    return "unknown"


def _output(command: list[str]) -> str:
    """What `command` prints, errors left out; nothing if it cannot be run or does not end.

    It runs in a folder of its own: `liggghts -h` leaves a log file where it is called.
    """
    with tempfile.TemporaryDirectory(prefix="crossgrain-version-") as folder:
        try:
            done = subprocess.run(  # noqa: S603  a fixed list of words, no shell
                command,
                cwd=folder,
                env=environment(Path(folder)),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                timeout=PATIENCE,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired):
            return ""
    return done.stdout.decode(errors="replace")
