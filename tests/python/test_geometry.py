"""Periodic images, cylinders and ensembles as the harness sees them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from cross_check import engine, reference
from cross_check.compare.quantities import impact, peak_force
from cross_check.geometry import effective_radius, facing, nearest
from cross_check.scene import Cylinder, Domain, Plane, from_json

GOOD = Path(__file__).parents[1] / "inputs" / "good"


def test_the_nearest_image_is_the_shortest_branch() -> None:
    domain = Domain((0.0, 0.0, 0.0), (1.0, 2.0, 3.0), ("periodic", "periodic", "open"))
    branch = nearest(domain, np.array([[0.9, -1.5, 2.9], [0.2, 4.1, 0.0]]))
    assert np.allclose(branch, [[-0.1, 0.5, 2.9], [0.2, 0.1, 0.0]], atol=1e-15)


def test_walls_face_the_particles() -> None:
    centers = np.array([[0.3, 0.4, 5.0]])
    normal, distance = facing(Cylinder((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), 2.0), centers)
    assert np.allclose(normal, [[-0.6, -0.8, 0.0]]) and distance == pytest.approx(1.5)
    normal, distance = facing(Plane((0.0, 0.0, 1.0), (0.0, 0.0, 1.0)), centers)
    assert np.allclose(normal, [[0.0, 0.0, 1.0]]) and distance == pytest.approx(4.0)
    assert effective_radius(Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 2.0), 0.5) == pytest.approx(2 / 3)
    assert effective_radius(Plane((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), 0.5) == 0.5


@pytest.mark.parametrize("name", ["periodic", "cylinder", "random", "lattice"])
def test_scenes_come_back_as_the_engine_wrote_them(name: str) -> None:
    for variant in engine.load_case(GOOD / f"{name}.toml").variants:
        for scene in variant.scenes:
            assert from_json(json.loads(scene.to_json())) == scene


def test_an_unknown_shape_is_refused() -> None:
    scene = engine.load_case(GOOD / "cylinder.toml").variants[0].scenes[0]
    raw = json.loads(scene.to_json())
    raw["bodies"][0]["shape"]["kind"] = "cone"
    with pytest.raises(ValueError, match="'cone' is unknown"):
        from_json(raw)


def test_every_seed_of_an_ensemble_is_a_member_of_its_own() -> None:
    case = engine.load_case(GOOD / "random.toml")
    assert [variant.member for variant in case.variants] == ["seed=1", "seed=2"]
    assert [variant.scenes[0].name for variant in case.variants] == ["random/seed=1", "random/seed=2"]
    first, second = (variant.scenes[0].particles for variant in case.variants)
    assert first[:150] != second[:150] and first[150] == second[150]


@pytest.mark.parametrize("name", ["periodic", "cylinder"])
def test_an_impact_across_a_face_and_in_a_cylinder_has_the_closed_form(name: str, tmp_path: Path) -> None:
    overrides = ["pairs.0.values.damping={ kind = 'none' }", "time.step.steps_per_contact=2000"]
    if name == "periodic":
        overrides += ["particles.0.position=[0.00899, 0, 0]", "particles.1.position=[-0.00899, 0, 0]"]
        overrides += ["particles.0.velocity=[0.5, 0, 0]", "particles.1.velocity=[-0.5, 0, 0]"]
    scene = engine.load_case(GOOD / f"{name}.toml", overrides).variants[0].scenes[0]
    record = engine.run(scene, tmp_path)
    found = impact(scene, record)
    assert found.overlap[0] == pytest.approx(-2e-5 if name == "periodic" else -0.00001, abs=3e-5)
    expected = reference.closed_forms()["hertz_impact.peak_force"](scene)
    assert peak_force(scene, record) == pytest.approx(float(expected), rel=1e-5)
