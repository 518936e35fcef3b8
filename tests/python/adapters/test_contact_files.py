"""Files of contacts, read strictly: what is not as ordered is an error with its place."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cross_check.adapters.contacts import Rows, contact_columns, pair_rows
from cross_check.adapters.dump import read_entries
from cross_check.adapters.interface import RunFailed
from cross_check.adapters.yade.parse import read_contacts

from . import scenes

COLUMNS = ("i", "j", "fx", "fy", "fz")
SCENE = replace(scenes.pair(), output_every=1000, contacts=True)


def frame(step: int, rows: list[str]) -> str:
    head = f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ENTRIES\n{len(rows)}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
    return head + "ITEM: ENTRIES i j fx fy fz \n" + "".join(f"{row}\n" for row in rows)


GOOD = frame(0, []) + frame(1000, ["2 1 1 0 0"]) + frame(2000, ["1 2 0.5 0 0", "2 1 3 0 0"])


def test_frames_may_be_empty_and_forces_belong_to_the_lower_index(tmp_path: Path) -> None:
    path = tmp_path / "contacts.dump"
    path.write_text(GOOD.replace("2 1 3 0 0\n", "").replace("ENTRIES\n2", "ENTRIES\n1"))
    sample, values = read_entries(path, COLUMNS, SCENE.sample_steps)
    rows = pair_rows(path, SCENE, sample, values[:, :2], values[:, 2:])
    wall = Rows(np.array([0]), np.array([[1, 2]]), np.array([[0.0, 0.0, 7.0]]))
    columns = contact_columns(path, 3, [rows, wall])
    assert columns["contact_start"].tolist() == [0, 1, 2, 3]
    assert columns["contact_pair"].tolist() == [[1, 2], [0, 1], [0, 1]]
    assert columns["contact_force"].tolist() == [[0.0, 0.0, 7.0], [-1.0, 0.0, 0.0], [0.5, 0.0, 0.0]]


def test_a_pair_that_stands_twice_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "contacts.dump"
    path.write_text(GOOD)
    sample, values = read_entries(path, COLUMNS, SCENE.sample_steps)
    with pytest.raises(RunFailed, match="contact 0-1 stands twice in sample 2"):
        contact_columns(path, 3, [pair_rows(path, SCENE, sample, values[:, :2], values[:, 2:])])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (GOOD.replace("1000\n", "1001\n"), "contacts.dump:11: '1001' in place of '1000'"),
        (GOOD.replace("fz \n", "fz q\n", 1), "contacts.dump:9: 'ITEM: ENTRIES i j fx fy fz q'"),
        (GOOD.replace("ENTRIES\n1", "ENTRIES\n-1"), "'-1' in place of a number of entries"),
        (GOOD.replace("0.5", "nan"), "not 5 finite numbers: '1 2 nan 0 0'"),
        (GOOD[: GOOD.index("1 2 0.5")], "more or fewer lines than the 3 frames"),
        (GOOD + GOOD, "more or fewer lines than the 3 frames"),
        ("", "contacts.dump:1: '' in place of 'ITEM: TIMESTEP'"),
    ],
)
def test_a_dump_that_is_not_as_ordered_is_refused(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "contacts.dump"
    path.write_text(text)
    with pytest.raises(RunFailed) as failure:
        read_entries(path, COLUMNS, SCENE.sample_steps)
    assert message in str(failure.value)


def test_an_id_that_is_no_particle_is_refused(tmp_path: Path) -> None:
    ids = np.array([[1.0, 3.0]])
    with pytest.raises(RunFailed, match="1 3 are no ids of the 2 particles"):
        pair_rows(tmp_path, SCENE, np.array([0]), ids, np.zeros((1, 3)))


HEAD = "step id1 id2 fx fy fz\n"


def test_yade_tells_the_force_on_the_second_side(tmp_path: Path) -> None:
    path = tmp_path / "contacts.txt"
    path.write_text(HEAD + "1000 1 0 2 0 0\n2000 0 1 3 0 0\n")
    columns = contact_columns(path, 3, [read_contacts(path, SCENE)])
    assert columns["contact_start"].tolist() == [0, 0, 1, 2]
    assert columns["contact_force"][:, 0].tolist() == [2.0, -3.0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (HEAD + "1001 1 0 2 0 0\n", "contacts.txt:2: step or ids are not those of a sample"),
        (HEAD + "2000 1 0 2 0 0\n1000 1 0 2 0 0\n", "contacts.txt:3: step or ids"),
        (HEAD + "1000 1 1 2 0 0\n", "contacts.txt:2: step or ids"),
        (HEAD + "1000 0 2 2 0 0\n", "contacts.txt:2: step or ids"),
        (HEAD + "1000 0 1 2 0\n", "contacts.txt:2: not 6 finite numbers"),
        (HEAD + "1000 0 1 2 0 0", "within a line"),
        ("step id fx fy fz\n", "contacts.txt:1: 'step id fx fy fz'"),
    ],
)
def test_a_table_of_yade_that_is_not_as_ordered_is_refused(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "contacts.txt"
    path.write_text(text)
    with pytest.raises(RunFailed) as failure:
        read_contacts(path, SCENE)
    assert message in str(failure.value)
