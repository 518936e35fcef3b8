"""What cannot be exported is one line that names it, and exit code 2."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from small_bed import Bed, without_contacts

from cross_check import export
from cross_check.cli import AS_EXPECTED, BAD_INPUT, main
from cross_check.export.trajectory import ExportError


def call(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["export", *map(str, arguments)], catch_exceptions=False)


@pytest.mark.parametrize("form", list(export.FORMATS))
def test_a_record_folder_becomes_files_that_are_named(bed: Bed, tmp_path: Path, form: str) -> None:
    done = call(bed.folder, "--to", form, "--out", tmp_path / "new" / "out", "--case", bed.case.path)
    assert done.exit_code == AS_EXPECTED, done.output
    listed = [Path(line) for line in done.output.splitlines()]
    assert all(path.is_file() for path in listed)
    index = json.loads((tmp_path / "new" / "out" / "export.json").read_text())
    assert index["files"] == [path.name for path in listed[:-1]]
    assert index["units"]["angular_velocity"] == "rad/s"
    assert index["velocity_time"] == "synchronized"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--to", "hdf"), "no such format hdf (known: pvd, dump, csv, vtu)"),
        (("--to", "csv", "--contacts"), "the record holds no contacts"),
        (("--to", "vtu", "--contacts"), "the format vtu holds no contacts (these do: pvd, dump, csv)"),
        (("--to", "csv", "--case", "free-fall"), "holds the case free-fall, the record is one of small-bed"),
        (("--to", "csv", "--case", "laws"), "cases, the record is of one"),
        (("--to", "csv", "--case", "no-such-case"), "no such suite, case or file"),
        (("--to", "csv", "--set", "time.step.value=1e-6"), "there is no --case"),
    ],
)
def test_bad_requests_are_refused(bed: Bed, tmp_path: Path, arguments: tuple[str, ...], words: str) -> None:
    folder = bed.folder
    if "holds no contacts" in words:
        folder = tmp_path / "record"
        without_contacts(bed.record).write(folder)
    done = call(folder, "--out", tmp_path / "out", *arguments)
    assert done.exit_code == BAD_INPUT
    assert words in done.output
    assert len(done.output.strip().splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_a_missing_record_is_named(tmp_path: Path) -> None:
    done = call(tmp_path / "nothing", "--to", "csv", "--out", tmp_path / "out")
    assert done.exit_code == BAD_INPUT
    assert f"{tmp_path / 'nothing' / 'record.json'}: no such file" in done.output


def test_a_folder_that_cannot_be_written_is_named(bed: Bed, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    done = call(bed.folder, "--to", "csv", "--out", tmp_path / "file" / "out")
    assert done.exit_code == BAD_INPUT
    assert str(tmp_path / "file") in done.output


def test_another_seed_of_the_case_is_not_taken_for_it(bed: Bed, tmp_path: Path) -> None:
    done = call(bed.folder, "--to", "csv", "--out", tmp_path, "--case", bed.case.path, "--set", "ensemble.seeds=[8]")
    assert done.exit_code == BAD_INPUT
    assert "has no scene of variant '', seed 7, refinement 0 (known: seed=8)" in done.output


def test_a_case_with_other_particles_is_not_taken_for_it(bed: Bed, tmp_path: Path) -> None:
    done = call(bed.folder, "--to", "csv", "--out", tmp_path, "--case", bed.case.path, "--set", "particles.0.count=3")
    assert done.exit_code == BAD_INPUT
    assert "states other particles or bodies" in done.output


def test_a_contact_across_a_periodic_face_needs_the_case(bed: Bed, tmp_path: Path) -> None:
    with pytest.raises(ExportError, match="of a periodic box, give the case"):
        export.write(bed.record, "pvd", tmp_path)


def broken(**changes: Any) -> dict[str, Any]:
    """Columns of three contacts in a record of eleven samples, but for `changes`; None leaves a column out."""
    columns: dict[str, Any] = {
        "contact_start": np.array([0] * 11 + [3]),
        "contact_pair": np.array([[0, 1], [1, 2], [2, 27]]),
        "contact_force": np.zeros((3, 3)),
    }
    return {name: values for name, values in (columns | changes).items() if values is not None}


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        (broken(contact_force=None), "contact_start stands without contact_force"),
        (broken(contact_start=np.array([0, 3])), "must hold 12 numbers that grow from 0"),
        (broken(contact_start=np.array([0, 4] + [3] * 10)), "must hold 12 numbers that grow from 0"),
        (broken(contact_force=np.zeros((2, 3))), "contact_start counts 3 contacts"),
        (broken(contact_pair=np.array([[0, 1], [1, 1], [2, 27]])), "contact_pair[1] = [1, 1]"),
        (broken(contact_pair=np.array([[0, 1], [1, 2], [2, 28]])), "the second below 28"),
        (broken(contact_pair=np.array([[0, 1], [1, 2], [25, 2]])), "the first below 25"),
        (broken(contact_force=np.full((3, 3), np.nan)), "not a finite number in row 0"),
    ],
)
def test_contacts_that_do_not_fit_are_refused(bed: Bed, tmp_path: Path, columns: dict[str, Any], words: str) -> None:
    plain = without_contacts(bed.record).columns
    with pytest.raises(ExportError, match=re.escape(words)):
        export.write(replace(bed.record, columns=plain | columns), "csv", tmp_path)
