"""Content-addressed store of run records: a run with the same inputs is never made twice."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from platformdirs import user_cache_path

import crossgrain
from cross_check import PACKAGE, engine
from cross_check.adapters.interface import Deck
from cross_check.measured import Measured
from cross_check.measured import read as read_measured
from cross_check.record import Code, RecordError, RunRecord, read
from cross_check.scene import Scene

VARIABLE = "CROSSGRAIN_CACHE"


def _digest(*parts: str) -> str:
    digest = hashlib.blake2b(digest_size=16)
    for part in parts:
        digest.update(f"{len(part)}:{part}".encode())
    return digest.hexdigest()


def native_key(scene: Scene) -> str:
    """Key of a native run: the scene and the engine's machine code."""
    return _digest("native", scene.digest(), engine.build())


def code_key(deck: Deck, code: Code) -> str:
    """Key of an external run: the deck, the program, and the sources of the harness that run and read it."""
    sources = [*sorted((PACKAGE / "adapters").rglob("*.py")), PACKAGE / "record.py"]
    return _digest(deck.code, deck.hash, code.version, code.package, *(path.read_text() for path in sources))


def measured_key(run: str, scene: Scene) -> str:
    """Key of what was measured of the run with a key: the observables, and the functions that measure."""
    asked, how = json.dumps(scene.observables, sort_keys=True), (PACKAGE / "measuring.py").read_text()
    return _digest("measured", run, asked, how, crossgrain.OBSERVABLES)


class Cache:
    """A folder of records by key; its index is the folder itself, so there is nothing to rebuild."""

    def __init__(self, root: Path | None = None) -> None:
        """The cache at `root`, at the folder that CROSSGRAIN_CACHE names, or in the user's cache folder."""
        chosen = root or (Path(os.environ[VARIABLE]) if VARIABLE in os.environ else user_cache_path("crossgrain"))
        self.root = chosen

    def folder(self, key: str) -> Path:
        """Where the record of a key lies."""
        return self.root / key[:2] / key

    def get(self, key: str) -> RunRecord | None:
        """The record of a key, or None; a damaged entry is dropped."""
        folder = self.folder(key)
        if not folder.is_dir():
            return None
        try:
            return read(folder)
        except RecordError:
            shutil.rmtree(folder, ignore_errors=True)
            return None

    def measured(self, key: str) -> Measured | None:
        """The measured record of a key, or None; a damaged entry is dropped."""
        folder = self.folder(key)
        if not folder.is_dir():
            return None
        try:
            return read_measured(folder)
        except RecordError:
            shutil.rmtree(folder, ignore_errors=True)
            return None

    def put(self, key: str, record: RunRecord) -> Path:
        """Stores a record and returns its folder."""
        return self._put(key, lambda folder: record.write(folder, compress=False))

    def put_measured(self, key: str, record: Measured) -> Path:
        """Stores a measured record and returns its folder."""
        return self._put(key, record.write)

    def _put(self, key: str, write: Callable[[Path], None]) -> Path:
        """The folder of a key: written beside its place and then renamed, never seen half."""
        target = self.folder(key)
        target.parent.mkdir(parents=True, exist_ok=True)
        scratch = Path(tempfile.mkdtemp(prefix="new-", dir=target.parent))
        write(scratch)
        try:
            scratch.rename(target)
        except OSError:  # another run was faster: its record is the same
            shutil.rmtree(scratch, ignore_errors=True)
        return target
