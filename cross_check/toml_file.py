"""TOML tables of the package."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


class TomlError(Exception):
    """A table that cannot be read; the message names the file and the reason."""


def read(path: Path) -> dict[str, Any]:
    """The table in a file. Raises TomlError."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise TomlError(f"{path}: {error}") from error
