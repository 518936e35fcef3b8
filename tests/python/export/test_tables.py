"""CSV tables as pandas reads them."""

from __future__ import annotations

# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# pandas brings no types of its own.
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from small_bed import Bed

from cross_check import export


@pytest.fixture(scope="module")
def folder(bed: Bed, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("csv")
    export.write(bed.record, "csv", place, case=bed.case)
    return place


def table(path: Path) -> Any:
    """A table with every bit, which pandas keeps from version 3 on by itself."""
    options: Any = {} if int(pd.__version__.split(".")[0]) >= 3 else {"float_precision": "round_trip"}
    return pd.read_csv(path, **options)


def vectors(read: Any, name: str, unit: str) -> Any:
    return read[[f"{name}_{axis} [{unit}]" for axis in "xyz"]].to_numpy()


def test_particles_read_back_to_the_same_bits(bed: Bed, folder: Path) -> None:
    read, shape = table(folder / "particles.csv"), bed.record["position"].shape
    assert len(read) == shape[0] * shape[1]
    assert np.array_equal(read[["x [m]", "y [m]", "z [m]"]].to_numpy().reshape(shape), bed.record["position"])
    for name, unit in (("velocity", "m/s"), ("angular_velocity", "rad/s"), ("force", "N"), ("torque", "N m")):
        assert np.array_equal(vectors(read, name, unit).reshape(shape), bed.record[name])
    one = read[read["particle"] == 24]
    assert one["time [s]"].tolist() == bed.record["time"].tolist()
    assert set(one["material"]) == {"steel"}
    assert set(one["mass [kg]"]) == {bed.record.header.mass[24]}


def test_series_hold_energies_and_the_force_of_every_body(bed: Bed, folder: Path) -> None:
    read = table(folder / "series.csv")
    for name in ("energy_kinetic", "energy_viscous", "energy_body_work"):
        assert np.array_equal(read[f"{name} [J]"], bed.record[name])
    for number, body in enumerate(("floor", "sliding", "pipe")):
        for place, axis in enumerate("xyz"):
            assert np.array_equal(read[f"body_force_{axis} {body} [N]"], bed.record["body_force"][:, number, place])


def test_contacts_name_particles_or_bodies(bed: Bed, folder: Path) -> None:
    read, columns = table(folder / "contacts.csv"), bed.record.columns
    assert np.array_equal(vectors(read, "force", "N"), columns["contact_force"])
    assert read["first"].tolist() == columns["contact_pair"][:, 0].tolist()
    names = dict(enumerate(("floor", "sliding", "pipe"), start=25))
    assert [
        names[other] if np.isnan(second) else int(second)
        for second, other in zip(read["second"], columns["contact_pair"][:, 1], strict=True)
    ] == [names.get(other, other) for other in columns["contact_pair"][:, 1].tolist()]
    assert read["body"].isna().sum() == read["second"].notna().sum() > 0
    assert read["body"].dropna().tolist() == [names[o] for o in columns["contact_pair"][:, 1].tolist() if o >= 25]
    counts = read.groupby("step").size().reindex(bed.record.step, fill_value=0)
    assert counts.tolist() == np.diff(columns["contact_start"]).tolist()


def test_a_normal_force_that_is_not_known_is_an_empty_cell(bed: Bed, tmp_path: Path) -> None:
    from dataclasses import replace

    columns = dict(bed.record.columns)
    pairs = columns["contact_pair"]
    columns["contact_pair"] = np.where(pairs[:, 1:] >= 25, pairs, [[3, 25]])
    export.write(replace(bed.record, columns=columns), "csv", tmp_path)
    read = table(tmp_path / "contacts.csv")
    assert read["normal_force [N]"].isna().all()
    assert read["force_x [N]"].notna().all()
