"""Claims about what is measured of a run of several stages, and what is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_cases import BED, PROFILE, SLIDE, load

import crossgrain
from cross_check import engine
from cross_check.engine import CaseError
from cross_check.measuring import measure
from cross_check.record import RecordError, RunRecord, read
from cross_check.scene import Scene


@pytest.fixture(scope="module")
def slide(tmp_path_factory: pytest.TempPathFactory) -> tuple[Scene, RunRecord]:
    folder = tmp_path_factory.mktemp("slide")
    scene = load(SLIDE, folder).variants[0].scenes[0]
    return scene, engine.run(scene, folder / "record")


def test_a_sample_at_the_end_of_a_stage_belongs_to_it(slide: tuple[Scene, RunRecord]) -> None:
    found = measure(*slide)
    assert found.stages == ("rough", "slick")
    assert [slide[0].stage_ends(), list(slide[1].step[[0, 20, 21, -1]])] == [[400, 800], [0, 400, 420, 800]]
    assert found.stage.tolist() == [0] * 21 + [1] * 20
    assert np.array_equal(found.time, slide[1]["time"])


def test_an_observable_sees_the_friction_of_its_stage(slide: tuple[Scene, RunRecord]) -> None:
    found = measure(*slide)
    assert found.value("on_rough", "rough", 0.5) == pytest.approx(1.0, rel=1e-12)
    assert found.value("on_slick", "slick", 0.5) == pytest.approx(1.0, rel=1e-12)
    # Where it is looked at in the other stage, it still has its own friction.
    assert found.value("on_rough", "slick", 0.5) == pytest.approx(0.5, rel=1e-12)
    assert found.value("on_slick", "rough", 0.5) == pytest.approx(2.0, rel=1e-12)


def test_actions_change_the_scene_of_their_stage_and_of_those_after_it(slide: tuple[Scene, RunRecord]) -> None:
    scene, _ = slide
    frictions = [[pair.friction for pair in scene.at_stage(index).pairs] for index in (0, 1)]
    assert frictions == [[0.5, 0.5], [0.5, 0.25]]


def test_a_record_without_the_contacts_that_an_observable_needs_is_refused(slide: tuple[Scene, RunRecord]) -> None:
    scene, record = slide
    few = {name: column for name, column in record.columns.items() if not name.startswith("contact_")}
    with pytest.raises(CaseError, match=r"slide, native: observable on_rough: sample 0: .*contacts"):
        measure(scene, RunRecord(record.header, few))


def test_a_record_with_missing_particles_is_refused(tmp_path: Path) -> None:
    scene = load(BED, tmp_path).variants[0].scenes[0]
    record = engine.run(scene, tmp_path / "record")
    short = {name: column[:, :7] if column.ndim == 3 and column.shape[1] == 8 else column
             for name, column in record.columns.items()}  # fmt: skip
    with pytest.raises(RecordError, match=r"column position has shape \(21, 7, 3\), expected \(21, 8, 3\)"):
        RunRecord(record.header, short).check("short")
    header = replace(record.header, mass=record.header.mass[:7], radius=record.header.radius[:7])
    RunRecord(header, short).check("consistent in itself")
    with pytest.raises(CaseError, match=r"small-bed/seed=1, native: column position has the shape \[21, 7, 3\], exp"):
        measure(scene, RunRecord(header, short))


def test_lists_and_numbers_are_measured_with_their_units(tmp_path: Path) -> None:
    scene = load(BED + PROFILE, tmp_path).variants[0].scenes[0]
    found = measure(scene, engine.run(scene, tmp_path / "record"))
    assert {name: values.shape for name, values in found.series.items()} == {
        "packing_fraction": (21,),
        "gain": (21,),
        "profile": (21, 4),
    }
    assert set(found.units.values()) == {"-"}
    volume, area = 8 * 4 / 3 * np.pi * 0.005**3, 0.024**2
    height = float(np.mean([particle.position[2] for particle in scene.particles]))
    assert found["packing_fraction"][0] == pytest.approx(volume / (2 * area * height), rel=1e-12)


def test_heights_are_counted_from_where_a_moving_floor_is(tmp_path: Path) -> None:
    falling = BED.replace('{ kind = "fixed" }', '{ kind = "prescribed", velocity = [0, 0, "-20 mm/s"] }')
    scene = load(falling, tmp_path).variants[0].scenes[0]
    record = engine.run(scene, tmp_path / "record")
    height = record["position"][-1, :, 2].mean() + 0.02 * record["time"][-1]
    expected = float(8 * 4 / 3 * np.pi * 0.005**3 / (2 * 0.024**2 * height))
    assert measure(scene, record)["packing_fraction"][-1] == pytest.approx(expected, rel=1e-9)


def summary(folder: Path, text: str) -> dict[str, Any]:
    """The observables of the summary of a native run."""
    path = folder / "case.toml"
    path.write_text(text)
    assert crossgrain.main(["run", str(path), "--out", str(folder / "out")]) == 0
    found: dict[str, Any] = json.loads((folder / "out" / "summary.json").read_text())["observables"]
    return found


def test_the_summary_of_a_native_run_has_the_observables_of_the_case(tmp_path: Path) -> None:
    text = SLIDE.replace('["wall", "glass"]', '["glass", "wall"]')
    found = summary(tmp_path, text)
    measured = measure(load(text, tmp_path).variants[0].scenes[0], read(tmp_path / "out" / "record"))
    for name, stage in (("on_rough", "rough"), ("on_slick", "slick")):
        assert found[name]["value"] == pytest.approx(measured.value(name, stage, 0.5), rel=1e-12)


def test_the_order_of_materials_in_an_action_does_not_matter_to_the_summary(tmp_path: Path) -> None:
    assert summary(tmp_path, SLIDE)["on_slick"]["value"] == pytest.approx(1.0, rel=1e-12)


def test_energies_that_were_not_asked_for_are_not_zero(tmp_path: Path) -> None:
    found = summary(tmp_path, SLIDE.replace("contacts = true", "contacts = true\nenergies = false"))
    assert found.get("elastic_energy", {"value": None})["value"] is None
