"""Runs many YADE decks in one process, because YADE starts slowly: `yade -n -x -j1 batch.py LIST PROGRESS`.

LIST names one deck per line. Every deck runs in its own folder, in an emptied simulation and in a fresh namespace, with
its output in log.txt there, so that it writes the very bytes that it writes when run alone. PROGRESS gets a line
`start I` before deck I and `done I SECONDS` or `failed I SECONDS` after it. Runs in YADE's own Python.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
import traceback
from pathlib import Path

from yade import O  # pyright: ignore[reportMissingImports, reportUnknownVariableType]


def run_deck(deck: Path) -> bool:
    """Runs one deck in its folder; whether it came to its end."""
    os.chdir(deck.parent)
    with Path("log.txt").open("wb") as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
    O.reset()  # pyright: ignore[reportUnknownMemberType]
    try:
        program = compile(deck.read_text(), deck.name, "exec")
        exec(program, {"__name__": "__main__", "__file__": deck.name})  # noqa: S102  what `yade DECK` does
    except BaseException:  # a deck that calls sys.exit must not end the batch either
        traceback.print_exc()
        return False
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
    return True


def run_batch(listing: Path, progress: Path) -> None:
    """Runs every deck of `listing` and reports to `progress`."""
    with progress.open("w", buffering=1) as report:
        for index, name in enumerate(listing.read_text().splitlines()):
            report.write(f"start {index}\n")
            begin = time.perf_counter()
            word = "done" if run_deck(Path(name)) else "failed"
            report.write(f"{word} {index} {time.perf_counter() - begin:.6f}\n")


run_batch(Path(sys.argv[1]), Path(sys.argv[2]))
# YADE leaves the empty folder of its temporary files behind.
with contextlib.suppress(OSError):
    Path(O.tmpFilename()).parent.rmdir()  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]
