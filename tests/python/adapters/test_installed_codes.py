"""The real codes, where they are installed, against the formulas integrated independently."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import Deck, NotComparable, RunFailed
from cross_check.adapters.render import number
from cross_check.record import RunRecord

from . import scenes

# Largest difference of a force from the formula, in units of the peak force: rounding of a whole collision, of which
# 1e-13 is seen.
FORCE_TOLERANCE = 1e-12
TIME_LIMIT = 60.0
SCENES = {
    "pair": scenes.pair(),
    "pair/on": scenes.pair("on", variant="pair/on"),
    "oblique": scenes.oblique_pair(),
    "floor": scenes.floor(),
    "corner": scenes.corner(),
    "fall": scenes.free_fall(),
    "powder": scenes.powder(),
    "boulder": scenes.boulder(),
    "soft": scenes.soft(),
}
Records = dict[str, RunRecord]


@pytest.fixture(scope="module", params=list(ADAPTERS))
def code(request: pytest.FixtureRequest) -> str:
    name = str(request.param)
    found = ADAPTERS[name].installed()
    if found is None:
        pytest.skip(f"{name} is not installed")
    if found.version not in ADAPTERS[name].proved_versions:
        pytest.skip(f"{name} {found.version} is not a proved version")
    return name


@pytest.fixture(scope="module")
def records(code: str, tmp_path_factory: pytest.TempPathFactory) -> Records:
    """All scenes run by one code, in one batch."""
    decks = [ADAPTERS[code].deck(whole) for whole in SCENES.values()]
    results = ADAPTERS[code].run(decks, tmp_path_factory.mktemp(code), TIME_LIMIT)
    for result in results:
        assert isinstance(result, RunRecord), str(result)
    return {name: result for name, result in zip(SCENES, results, strict=True) if isinstance(result, RunRecord)}


def run_one(code: str, deck: Deck, folder: Path) -> RunRecord:
    (result,) = ADAPTERS[code].run([deck], folder, TIME_LIMIT)
    assert isinstance(result, RunRecord), str(result)
    return result


@pytest.mark.parametrize("name", [name for name in SCENES if name != "fall"])
def test_whole_force_history_is_the_formula(code: str, records: Records, name: str) -> None:
    mirror = ADAPTERS[code].mirror(SCENES[name])
    places, forces = scenes.integrate(
        SCENES[name], mirror.model.normal.force_cut == "on", mirror.mirror.plane_radius_factor
    )
    record, peak = records[name], float(np.abs(forces).max())
    assert peak > 0
    assert float(np.abs(record["force"] - forces).max()) < FORCE_TOLERANCE * peak
    travelled = float(np.abs(places - places[0]).max())
    assert float(np.abs(record["position"] - places).max()) < FORCE_TOLERANCE * travelled


def test_pair_collision_has_the_proved_numbers(code: str, records: Records) -> None:
    for name, rebound in (("pair", 0.8081084426 if code == "yade" else 0.8000258073), ("pair/on", 0.8081084426)):
        velocity = records[name].synchronized_velocity()
        assert float(velocity[-1, 1, 0] - velocity[-1, 0, 0]) == pytest.approx(rebound, abs=1e-10)
        assert float(np.abs(records[name]["force"]).max()) == pytest.approx(1.063483727, abs=1e-9)


def test_contacts_are_frictionless(code: str, records: Records) -> None:
    """YADE forms arm x normal force, which is zero up to rounding only; the others write no torque at all."""
    for name, record in records.items():
        arm, peak = max(record.header.radius), float(np.abs(record["force"]).max())
        spin = record["angular_velocity"]
        assert float(np.abs(record["torque"]).max()) <= (1e-14 * peak * arm if code == "yade" else 0.0), name
        assert float(np.abs(spin - spin[0]).max()) <= (1e-12 if code == "yade" else 0.0), name
    force, position = records["oblique"]["force"], records["oblique"]["position"]
    normal = position[:, 0] - position[:, 1]
    tangential = np.cross(force[:, 0], normal / np.linalg.norm(normal, axis=1)[:, None])
    assert float(np.abs(tangential).max()) < 1e-14 * float(np.abs(force).max())


def test_bodies_feel_the_opposite_of_the_particles(records: Records) -> None:
    """The force of a particle holds one rounding of its weight, that of a body none."""
    for name in ("floor", "boulder"):
        record = records[name]
        peak = float(np.abs(record["force"]).max())
        difference = record["body_force"][:, 0] + record["force"][:, 0]
        assert float(np.abs(difference).max()) <= 1e-15 * peak
    corner = records["corner"]
    assert float(np.abs(corner["body_force"] + corner["force"]).max()) == 0.0
    assert float(corner["body_force"][:, 0, 2].max()) > 0
    assert float(corner["body_force"][:, 1, 0].min()) < 0


def test_free_fall_is_the_parabola(code: str, records: Records) -> None:
    record, whole = records["fall"], SCENES["fall"]
    time = record["time"][:, None]
    particle, gravity = whole.particles[0], np.array(whole.gravity)
    parabola = np.array(particle.position) + np.array(particle.velocity) * time + 0.5 * gravity * time**2
    assert float(np.abs(record["position"][:, 0] - parabola).max()) < 1e-12
    speed = np.array(particle.velocity) + gravity * time
    assert float(np.abs(record.synchronized_velocity()[:, 0] - speed).max()) < 1e-12
    assert record.header.velocity_time == ("half_step" if code == "yade" else "synchronized")
    assert float(np.abs(record["force"]).max()) < 1e-15 * particle.mass * 9.9


def test_fewer_samples_are_the_same_numbers(code: str, records: Records, tmp_path: Path) -> None:
    record = run_one(code, ADAPTERS[code].deck(scenes.sampled(SCENES["floor"], 40)), tmp_path)
    for name, column in records["floor"].columns.items():
        assert np.array_equal(column[::40], record.columns[name]), name


def test_a_second_run_is_the_same_bytes(code: str, tmp_path: Path) -> None:
    deck = ADAPTERS[code].deck(SCENES["oblique"])
    first, second = (run_one(code, deck, tmp_path / side) for side in ("a", "b"))
    for name, column in first.columns.items():
        assert column.tobytes() == second.columns[name].tobytes(), name


def test_a_floor_that_slides_changes_nothing_without_friction(code: str, tmp_path: Path) -> None:
    fixed = run_one(code, ADAPTERS[code].deck(replace(scenes.floor(), gravity=scenes.ZERO)), tmp_path / "fixed")
    sliding = run_one(code, ADAPTERS[code].deck(scenes.moving_floor((2.0, 0.0, 0.0))), tmp_path / "sliding")
    peak = float(np.abs(fixed["force"]).max())
    assert float(np.abs(fixed["force"] - sliding["force"]).max()) < FORCE_TOLERANCE * peak


def test_a_floor_that_rises_is_the_fall_seen_from_it(code: str, tmp_path: Path) -> None:
    rising = run_one(code, ADAPTERS[code].deck(scenes.moving_floor((0.0, 0.0, 0.25))), tmp_path)
    seen = replace(scenes.floor(), gravity=scenes.ZERO)
    particle = replace(seen.particles[0], velocity=(0.1, 0.0, -0.75))
    seen = replace(seen, particles=(particle,))
    _, forces = scenes.integrate(seen, True, ADAPTERS[code].mirror(seen).mirror.plane_radius_factor)
    peak = float(np.abs(forces).max())
    assert float(np.abs(rising["force"] - forces).max()) < FORCE_TOLERANCE * peak
    assert float(np.abs(rising["force"] + rising["body_force"]).max()) == 0.0


def test_a_roof_that_sinks_on_two_materials(code: str, tmp_path: Path) -> None:
    """The mesh of LIGGGHTS and the region of LAMMPS seen from the other side.

    The gaps are no multiples of v dt: an overlap of 0 or 1 rounding at the first touch would change the damping force,
    which grows with the fourth root of the overlap, beyond any tolerance.
    """
    left = scenes.sphere(5e-3, (0.02, 0.0, 0.04490007))
    right = scenes.sphere(3e-3, (-0.02, 0.0, 0.04690009), material=1, density=7800.0)
    materials = (scenes.GLASS, scenes.STEEL, scenes.RIGID)
    whole = scenes.scene(left, right, materials=materials, force_cut="on", variant="roof")
    roof = scenes.plane("roof", 2, (0.0, 0.0, 0.05), (0.0, 0.0, -1.0), (0.0, 0.0, -0.5))
    record = run_one(code, ADAPTERS[code].deck(replace(whole, bodies=(roof,))), tmp_path)
    fixed = scenes.plane("roof", 2, (0.0, 0.0, 0.05), (0.0, 0.0, -1.0))
    rising = tuple(replace(particle, velocity=(0.0, 0.0, 0.5)) for particle in whole.particles)
    seen = replace(whole, bodies=(fixed,), particles=rising)
    _, forces = scenes.integrate(seen, True, ADAPTERS[code].mirror(seen).mirror.plane_radius_factor)
    # The plane adds up its way from 0.05 m in steps of 2.5e-7 m, which costs two digits of the overlap.
    assert float(np.abs(record["force"] - forces).max()) < 1e-10 * float(np.abs(forces).max())


def test_contact_through_a_periodic_boundary(code: str, tmp_path: Path) -> None:
    left, right = scenes.pair().particles
    whole = scenes.scene(left, replace(right, position=(8.00125e-3, 0.0, 0.0)), force_cut="on")
    domain = replace(whole.domain, boundary=("periodic", "open", "open"))
    shift = 0.1 - 4e-3
    apart = tuple(replace(p, position=((p.position[0] + shift + 0.1) % 0.2 - 0.1, 0.0, 0.0)) for p in whole.particles)
    assert apart[1].position[0] < 0
    try:
        deck = ADAPTERS[code].deck(replace(whole, domain=domain, particles=apart))
    except NotComparable as reason:
        pytest.skip(str(reason))
    record = run_one(code, deck, tmp_path)
    _, forces = scenes.integrate(whole, True, None)
    # Coordinates of 0.1 m in place of 0.005 m: the overlap loses two digits.
    assert float(np.abs(record["force"] - forces).max()) < 1e-8 * float(np.abs(forces).max())


class TestYadeBatch:
    """Many decks in one process."""

    @pytest.fixture(autouse=True)
    def _needs_yade(self) -> None:
        if ADAPTERS["yade"].installed() is None:
            pytest.skip("yade is not installed")

    def test_batch_writes_the_bytes_of_a_run_by_hand(self, tmp_path: Path) -> None:
        names = ("floor", "oblique", "corner", "floor")
        decks = [ADAPTERS["yade"].deck(SCENES[name]) for name in names]
        results = ADAPTERS["yade"].run(decks, tmp_path / "batch", TIME_LIMIT)
        assert all(isinstance(result, RunRecord) for result in results)
        folders = sorted((tmp_path / "batch").iterdir())
        program = shutil.which("yade")
        assert program is not None
        for deck, folder in list(zip(decks, folders, strict=True))[1:]:
            alone = tmp_path / f"alone-{folder.name}"
            alone.mkdir()
            (alone / deck.main).write_text(deck.files[deck.main])
            subprocess.run(
                [program, "-n", "-x", "-j1", deck.main], cwd=alone, check=True, timeout=60, capture_output=True
            )
            for file in ("particles.txt", "walls.txt"):
                assert (alone / file).read_bytes() == (folder / file).read_bytes(), (folder.name, file)

    def test_a_deck_that_fails_dies_or_hangs_leaves_the_others_alone(self, tmp_path: Path) -> None:
        good = ADAPTERS["yade"].deck(scenes.sampled(SCENES["pair"], 100))

        def bad(text: str) -> Deck:
            return replace(good, files={good.main: text})

        decks = [
            good,
            bad("raise ValueError('planted')\n"),
            good,
            bad("import os\nprint('planted abort', flush=True)\nos.abort()\n"),
            good,
            bad("import time\ntime.sleep(100)\n"),
            bad("import sys\nsys.exit(0)\n"),
            good,
        ]
        results = ADAPTERS["yade"].run(decks, tmp_path, 4.0)
        assert [isinstance(result, RunFailed) for result in results] == [
            False,
            True,
            False,
            True,
            False,
            True,
            True,
            False,
        ]
        assert "ValueError: planted" in str(results[1])
        assert "saying: planted abort" in str(results[3])
        assert "did not finish within 4 s" in str(results[5])
        assert "SystemExit" in str(results[6])
        first = results[0]
        assert isinstance(first, RunRecord)
        for index in (2, 4, 7):
            result = results[index]
            assert isinstance(result, RunRecord)
            assert all(first[name].tobytes() == result[name].tobytes() for name in first.columns)


def test_a_deck_that_lammps_or_liggghts_rejects_is_a_failure(code: str, tmp_path: Path) -> None:
    if code == "yade":
        pytest.skip("covered by its batch")
    deck = ADAPTERS[code].deck(SCENES["pair"])
    text = deck.files[deck.main].replace("timestep        " + number(5e-7), "timestap 1")
    (result,) = ADAPTERS[code].run([replace(deck, files={deck.main: text})], tmp_path, TIME_LIMIT)
    assert isinstance(result, RunFailed)
    assert "ended with exit code 1, saying: ERROR: Unknown command: timestap" in str(result)
