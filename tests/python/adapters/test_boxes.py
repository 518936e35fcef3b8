"""Periodic boxes and cylinders in the real codes against their mirrors: whole histories, positions without jumps."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cross_check import engine
from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import NotComparable
from cross_check.scene import Body, Cylinder, Domain, Motion, Scene, Vector

from . import contact_scenes, scenes
from .test_friction import TOLERANCE, Records, check_history, run_all

# In a cylinder the overlap is what is left of three lengths some hundred times as large.
CYLINDER_TOLERANCE = 1e-9

SIZE = 0.05
NAMES = "xyz"


def boxed(whole: Scene, periodic: str, variant: str, size: float = SIZE) -> Scene:
    """The scene in a box of half the edge `size` [m] that is periodic along the axes named."""
    x, y, z = ("periodic" if axis in periodic else "open" for axis in NAMES)
    return replace(whole, domain=Domain((-size, -size, -size), (size, size, size), (x, y, z)), variant=variant)


def across(whole: Scene, shift: Vector) -> Scene:
    """The scene with its particles shifted by `shift` [m], those beyond the upper faces on the other side."""

    def moved(place: Vector) -> Vector:
        x, y, z = (a + b - (2 * SIZE if a + b >= SIZE else 0.0) for a, b in zip(place, shift, strict=True))
        return (x, y, z)

    return replace(whole, particles=tuple(replace(p, position=moved(p.position)) for p in whole.particles))


def runner(whole: Scene, variant: str) -> Scene:
    """A spinning sphere that bounces on a floor and leaves a box of 4 cm twice along x meanwhile."""
    fast = replace(whole.particles[0], velocity=(70.0, -3.0, -0.5), angular_velocity=(30.0, -40.0, 25.0))
    whole = contact_scenes.mindlin(replace(whole, particles=(fast,)), 0.4, variant)
    return boxed(whole, "xy", variant, 0.02)


def tube(axis: int, friction: float | None, velocity: float = 0.0) -> Scene:
    """A spinning sphere of 5 mm that hits the inside of a cylinder of 20 mm off the origin, at rest or sliding."""
    first, second = (axis + 1) % 3, (axis + 2) % 3
    position, speed, spin, unit, sliding = [0.0] * 3, [0.0] * 3, [0.0] * 3, [0.0] * 3, [0.0] * 3
    spin[first], spin[second], spin[axis] = 30.0, -40.0, 25.0
    position[first], position[second], position[axis] = 0.003 + 0.6 * 0.01499, -0.002 + 0.8 * 0.01499, 0.001
    speed[first], speed[second], speed[axis] = 0.6 * 0.5 + 0.08, 0.8 * 0.5 - 0.06, 0.2
    unit[axis], sliding[axis] = 1.0, velocity
    center = [0.0] * 3
    center[first], center[second] = 0.003, -0.002

    def vector(values: list[float]) -> Vector:
        return (values[0], values[1], values[2])

    ball = scenes.sphere(5e-3, vector(position), vector(speed), vector(spin) if friction else scenes.ZERO)
    motion = Motion("prescribed", vector(sliding)) if velocity else Motion("fixed")
    body = Body("tube", 1, Cylinder(vector(center), vector(unit), 0.02), motion)
    name = f"tube/{NAMES[axis]}/{'frictionless' if friction is None else 'sliding' if velocity else 'friction'}"
    whole = scenes.scene(ball, bodies=(body,), force_cut="on", variant=name)
    whole = whole if friction is None else contact_scenes.mindlin(whole, friction, name)
    return boxed(whole, NAMES[axis], name)


def faces() -> dict[str, Scene]:
    """Collisions across one face and across three at once, and a flight through faces above a floor."""
    pair = contact_scenes.mindlin(scenes.oblique_pair(), 0.9, "pair")
    corner = across(pair, (0.0365, 0.0274, 0.0181))
    return {
        "face": across(boxed(pair, "x", "box/face"), (0.0365, 0.0, 0.0)),
        "corner": boxed(corner, "xyz", "box/corner"),
        "floor": runner(scenes.floor(), "box/floor"),
        "rising": runner(scenes.rising_floor(), "box/rising"),
    }


BOXES = faces()
TUBES = {whole.variant: whole for axis in range(3) for whole in (tube(axis, None), tube(axis, 0.3))}
TUBES["tube/z/sliding"] = tube(2, 0.3, 0.4)


@pytest.fixture(scope="module", params=list(ADAPTERS))
def code(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def records(code: str, tmp_path_factory: pytest.TempPathFactory) -> Records:
    wanted = {name: whole for name, whole in (BOXES | TUBES).items() if code != "yade" or not whole.bodies}
    return run_all(code, wanted, tmp_path_factory)


def check_positions(
    record: Records, name: str, whole: Scene, code: str, folder: Path, tolerance: float = TOLERANCE
) -> None:
    """Compares places with the mirror of the code, in units of the longest way."""
    mirror = engine.run(ADAPTERS[code].mirror(whole), folder / "places")
    way = float(np.abs(mirror["position"] - mirror["position"][0]).max())
    worst = float(np.abs(record[name]["position"] - mirror["position"]).max()) / way
    print(f"{code} {whole.variant}: position {worst:.1e} of the way")  # noqa: T201
    assert worst < tolerance


@pytest.mark.parametrize("name", list(BOXES))
def test_contacts_and_flights_through_faces_are_the_mirror(
    code: str, records: Records, name: str, tmp_path: Path
) -> None:
    if code == "yade" and BOXES[name].bodies:
        with pytest.raises(NotComparable, match="Wall body in a periodic cell"):
            ADAPTERS[code].deck(BOXES[name])
        return
    check_history(records[name], BOXES[name], code, tmp_path)
    check_positions(records, name, BOXES[name], code, tmp_path)


@pytest.mark.parametrize("code", ["liggghts", "lammps"], indirect=True)
def test_positions_run_on_where_a_face_is_crossed(records: Records) -> None:
    place = records["floor"]["position"][:, 0, 0]
    assert place[-1] > 0.06, "the sphere leaves the box at 0.02 m and its image at 0.06 m"
    assert float(np.abs(np.diff(place)).max()) < 71.0 * BOXES["floor"].time_step


@pytest.mark.parametrize("name", list(TUBES))
def test_cylinders_are_the_mirror(code: str, records: Records, name: str, tmp_path: Path) -> None:
    if code == "yade":
        with pytest.raises(NotComparable, match="counted by every facet"):
            ADAPTERS[code].deck(TUBES[name])
        return
    check_history(records[name], TUBES[name], code, tmp_path, CYLINDER_TOLERANCE)
    check_positions(records, name, TUBES[name], code, tmp_path, CYLINDER_TOLERANCE)


def test_curvature_of_a_cylinder_is_a_difference_of_the_codes(tmp_path: Path) -> None:
    """R*: native R Rc/(Rc - R), LAMMPS 2 R Rc/(2 Rc - R), LIGGGHTS R; the peak of an elastic impact is R*^(1/5)."""
    whole = tube(2, None)
    # Straight at the wall: a sphere that also slides meets a normal that turns.
    whole = replace(whole, particles=(replace(whole.particles[0], velocity=(0.3, 0.4, 0.0)),))
    pairs = tuple(replace(pair, damping_ratio=0.0, restitution=1.0) for pair in whole.pairs)
    whole = replace(whole, pairs=pairs)

    def peak(scene: Scene, name: str) -> float:
        return float(np.linalg.norm(engine.run(scene, tmp_path / name)["force"], axis=2).max())

    plain, flat = peak(whole, "plain"), peak(ADAPTERS["liggghts"].mirror(whole), "liggghts")
    half = peak(ADAPTERS["lammps"].mirror(whole), "lammps")
    assert plain / flat == pytest.approx((20 / 15) ** 0.2, rel=1e-5)
    assert half / flat == pytest.approx((40 / 35) ** 0.2, rel=1e-5)
