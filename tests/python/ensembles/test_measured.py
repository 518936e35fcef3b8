"""Claims about measured records and the ensembles made of them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from measured_runs import SEEDS, UNITS, bed, run, with_header

from cross_check.compare.curve_ensembles import aligned
from cross_check.ensembles import ensemble, same_seeds
from cross_check.measured import Measured, read
from cross_check.record import Code, RecordError


def test_a_record_comes_back_to_the_bit(tmp_path: Path) -> None:
    record = run()
    record.write(tmp_path)
    again = read(tmp_path, UNITS)
    assert again.header == record.header
    assert (again.stages, again.units) == (record.stages, record.units)
    assert all(np.array_equal(again[name], record[name]) for name in UNITS)
    assert again.digest() == record.digest()


def test_a_record_of_500_particles_takes_a_few_kilobytes(tmp_path: Path) -> None:
    run().write(tmp_path)
    assert sum(path.stat().st_size for path in tmp_path.iterdir()) < 8000


def test_the_digest_sees_every_bit_of_what_was_measured_and_nothing_else() -> None:
    record = run()
    assert with_header(record, wall_time=99.0, machine="another").digest() == record.digest()
    touched = {name: np.array(array) for name, array in record.series.items()}
    touched["wall_force"][7, 1] = np.nextafter(touched["wall_force"][7, 1], 9.0)
    others = [
        replace(record, series=touched),
        replace(record, time=np.nextafter(record.time, 9.0)),
        replace(record, units=UNITS | {"coordination": "1"}),
        replace(record, stages=("fill", "relax")),
        replace(record, stage=np.repeat([0, 1], [41, 59])),
    ]
    assert len({record.digest(), *(other.digest() for other in others)}) == 6


def test_a_value_is_the_mean_over_the_last_share_of_its_stage() -> None:
    record = replace(
        run(), series={"count": np.arange(100.0), "pair": np.ones((100, 2))}, units={"count": "-", "pair": "N"}
    )
    assert record.value("count", "relax", 0.1) == np.mean(np.arange(94, 100))
    assert record.value("count", "relax", 1.0) == np.mean(np.arange(40, 100))
    assert record.value("count", "pour", 0.05) == np.mean([38, 39])
    assert record.value("count", "pour", 1e-9) == 39.0
    assert record.value("count", "pour", 0.0) == 39.0
    assert record.values("pair", "pour", 0.5).tolist() == [1.0, 1.0]
    with pytest.raises(RecordError, match="pair has 2 components, expected a scalar"):
        record.value("pair", "pour", 0.5)
    for share in (-0.1, 1.5):
        with pytest.raises(RecordError, match="expected a share from 0 to 1"):
            record.value("count", "pour", share)


def test_unknown_names_list_the_known_ones() -> None:
    record = run()
    with pytest.raises(
        RecordError, match=r"no observable porosity \(known: packing_fraction, coordination, wall_force\)"
    ):
        record["porosity"]
    with pytest.raises(RecordError, match=r"no stage shear \(known: pour, relax\)"):
        record.curve("coordination", "shear")
    empty = replace(record, stages=("pour", "relax", "shear"))
    with pytest.raises(RecordError, match="stage shear has no samples"):
        empty.samples_of("shear")


def broken() -> dict[str, tuple[Measured, str]]:
    record = run()
    nan = {name: np.array(array) for name, array in record.series.items()}
    nan["coordination"][3] = np.inf
    short = record.series | {"coordination": np.zeros(7)}
    return {
        "nan": (replace(record, series=nan), "coordination is infinite at time 0.03 s"),
        "short": (replace(record, series=short), r"coordination has shape \(7,\), expected \(100,\) or \(100, K\)"),
        "unit": (replace(record, units={"coordination": "-"}), "packing_fraction has no unit"),
        "series": (replace(record, units=UNITS | {"porosity": "-"}), "porosity has a unit and no series"),
        "reserved": (
            replace(record, series={"radius": record.time}, units={"radius": "m"}),
            "radius has a reserved name",
        ),
        "backwards": (replace(record, time=record.time[::-1]), "times are not finite and increasing"),
        "stages": (replace(record, stage=np.repeat([1, 0], [40, 60])), "stages of samples do not count up"),
        "outside": (replace(record, stage=np.repeat([0, 2], [40, 60])), "within the 2 stages"),
        "twice": (replace(record, stages=("pour", "pour")), "two stages have the same name"),
        "no samples": (
            replace(record, time=np.zeros(0), stage=np.zeros(0, dtype=int), series={}, units={}),
            "expected at least one sample",
        ),
    }


@pytest.mark.parametrize("name", broken())
def test_a_broken_record_is_not_written(name: str, tmp_path: Path) -> None:
    record, message = broken()[name]
    with pytest.raises(RecordError, match=message):
        record.write(tmp_path / "record")
    assert not (tmp_path / "record").exists()


def test_names_and_units_are_held_against_a_table(tmp_path: Path) -> None:
    run().write(tmp_path)
    with pytest.raises(RecordError, match=r"unknown observable wall_force \(known: packing_fraction, coordination\)"):
        read(tmp_path, {"packing_fraction": "-", "coordination": "-"})
    with pytest.raises(RecordError, match="wall_force is in N, expected Pa"):
        read(tmp_path, UNITS | {"wall_force": "Pa"})


def test_files_that_are_no_record_are_refused_by_name(tmp_path: Path) -> None:
    run().write(tmp_path)
    path = tmp_path / "measured.json"
    content = json.loads(path.read_text())

    def refused(change: dict[str, object], message: str) -> None:
        path.write_text(json.dumps(content | change))
        with pytest.raises(RecordError, match=message):
            read(tmp_path)

    refused({"schema": 2}, "measured.json: schema 2, this version reads schema 1")
    refused({"extra": 1}, "keys extra are unknown or missing")
    refused({"header": content["header"] | {"colour": "red"}}, "not a readable measured record.*colour")
    refused({"observables": {"coordination": "-"}}, "packing_fraction has no unit")
    path.write_text(json.dumps(content))
    archive = tmp_path / "series.npz"
    archive.write_bytes(archive.read_bytes()[:-200])
    with pytest.raises(RecordError, match="not a readable measured record"):
        read(tmp_path)
    archive.unlink()
    with pytest.raises(RecordError, match=r"series.npz: no such file"):
        read(tmp_path)


def test_an_ensemble_is_in_the_order_of_its_seeds() -> None:
    found = ensemble([run(seed=seed) for seed in (3, 1, 5, 2, 4)], SEEDS)
    assert found.seeds == SEEDS
    expected = [run(seed=seed).value("coordination", "relax", 0.5) for seed in SEEDS]
    assert found.values("coordination", "relax", 0.5).tolist() == expected
    assert found.unit("wall_force") == "N"


def test_curves_of_an_ensemble_begin_with_their_stage() -> None:
    times, (curves,) = aligned(bed().curves("packing_fraction", "relax"))
    assert (times[0], curves.shape) == (0.0, (5, 60))
    with pytest.raises(RecordError, match="wall_force has 3 components"):
        bed().curves("wall_force", "relax")


def test_missing_double_and_foreign_records_are_refused() -> None:
    records = [run(seed=seed) for seed in SEEDS]
    cases = {
        r"no record for the seeds 2, 5 \(there: 1, 3, 4\)": [records[0], records[2], records[3]],
        "seed=3: two records have this seed": [*records, records[2]],
        "records for the seeds 6, which the case does not have": [*records, run(seed=6)],
        "the record has no seed": [*records[:4], run(seed=None)],
        "an ensemble of different runs: native .* and yade": [*records[:4], run("yade", 5)],
        "native 0.2.0": [*records[:4], run(seed=5, version="0.2.0")],
        "its observables or stages": [*records[:4], replace(records[4], stages=("fill", "relax"))],
        "at least one record": [],
    }
    for message, members in cases.items():
        with pytest.raises(RecordError, match=message):
            ensemble(members, SEEDS)


def test_seeds_that_differ_between_codes_are_told() -> None:
    same_seeds(bed(), bed("yade"))
    few = ensemble([run("yade", seed) for seed in (1, 2, 4)], (1, 2, 4))
    with pytest.raises(RecordError, match="native has the seeds 1, 2, 3, 4, 5, yade has 1, 2, 4"):
        same_seeds(bed(), few)
    other = ensemble([with_header(run("yade", 1), case="silo", code=Code("yade", "1", ""))], (1,))
    with pytest.raises(RecordError, match=r"ensembles of poured-bed/friction=0\.5 and of silo/friction=0\.5"):
        same_seeds(bed(), other)
