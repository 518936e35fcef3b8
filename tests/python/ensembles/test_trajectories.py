"""Claims about the check `horizon`: a code and its mirror compute the same trajectory for some time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from small_cases import BED, load

from cross_check import engine
from cross_check.compare.checks import compare
from cross_check.compare.outcome import NATIVE, Outcome, mirror_name
from cross_check.compare.quantity import Undefined
from cross_check.compare.trajectories import describe, pairs, parting
from cross_check.compare.verdicts import AGREE, DIFFER, Comparison, not_run
from cross_check.engine import Gate
from cross_check.record import Code, Header, RunRecord
from cross_check.scene import Scene

Array = NDArray[Any]
DIAMETER = 0.01
STEPS = np.arange(0, 401, 20)
TIME = STEPS * 5e-5


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    return load(BED, tmp_path_factory.mktemp("bed")).variants[0].scenes[0]


def record(scene: Scene, source: str, off: Array, steps: Array = STEPS) -> RunRecord:
    """Particles that move as one; the fourth is off by `off` [m], shape (21,)."""
    start = np.array([particle.position for particle in scene.particles])
    position = start + 0.1 * (STEPS * 5e-5)[:, None, None]
    position[:, 3, 1] += off
    header = Header(
        source, scene.case, scene.variant, scene.seed, 0, Code("test", "1", "test"), "", "", 0.0, scene.time_step,
        scene.steps, "synchronized", "exact", [1.0] * 8, [0.005] * 8, ["floor"], [0.0, 0.0, -9.81],
    )  # fmt: skip
    kept = np.isin(STEPS, steps)
    return RunRecord(header, {"step": STEPS[kept], "position": position[kept]})


def growing(rate: float, start: float) -> Array:
    """A difference that grows exponentially, in diameters."""
    return DIAMETER * start * np.exp(rate * TIME)


def judged(scene: Scene, bound: float, mirror: Array, native: Array, steps: Array = STEPS) -> Comparison:
    """The comparison of a code with its mirror; `mirror` and `native` are their distances from it."""
    records = {"lammps": 0.0 * TIME, mirror_name("lammps"): mirror, NATIVE: native}
    outcomes = {
        (source, 0): Outcome(source, scene, record(scene, source, off, steps if source == "lammps" else STEPS))
        for source, off in records.items()
    }
    gate = Gate("trajectory", "horizon", None, "absolute", bound, "the test", None)
    (found,) = compare(scene, gate, outcomes, ("lammps",))
    return found


def test_the_horizon_is_when_the_first_particle_is_off_by_a_millionth_of_a_diameter(scene: Scene) -> None:
    horizon = np.log(1e6) / 2000.0  # from 1e-12 to 1e-6 diameters
    mirror, native = growing(2000.0, 1e-12), growing(4000.0, 1e-12)
    found = judged(scene, 0.9 * horizon, mirror, native)
    assert found.verdict == AGREE
    assert found.left.value == pytest.approx(horizon, rel=1e-9)
    assert found.right.value == TIME[-1]
    assert found.discrepancy == 0.0
    assert found.unit == "s"
    short = judged(scene, 1.1 * horizon, mirror, native)
    assert short.verdict == DIFFER
    assert short.discrepancy == pytest.approx(0.1 * horizon, rel=1e-9)


def test_the_note_tells_horizons_and_growth_of_mirror_and_native(scene: Scene) -> None:
    found = judged(scene, 1e-3, growing(2000.0, 1e-12), growing(1200.0, 1e-10))
    mirror, native = found.note.split(". native and lammps: ")
    assert mirror.startswith("native[lammps] and lammps: passes 1e-06 d at 0.006908 s, passes 0.01 d at 0.01151 s")
    assert "grows as exp(2e+03 t / s)" in mirror
    assert "grows as exp(1.2e+03 t / s)" in native


def test_native_is_told_and_not_judged(scene: Scene) -> None:
    assert judged(scene, 0.02, 0.0 * TIME, np.full(21, DIAMETER)).verdict == AGREE


def test_runs_that_never_part_have_the_whole_run_as_their_window(scene: Scene) -> None:
    found = judged(scene, TIME[-1], 0.0 * TIME, 0.0 * TIME)
    assert (found.verdict, found.left.value) == (AGREE, TIME[-1])
    assert "passes 1e-06 d never, passes 0.01 d never" in found.note
    assert "a fit needs" in found.note


def test_only_common_samples_are_compared(scene: Scene) -> None:
    late = np.where(TIME > 0.0145, DIAMETER, 0.0)
    assert judged(scene, 1e-3, late, late).left.value == pytest.approx(0.014)
    assert judged(scene, 1e-3, late, late, steps=STEPS[::2]).left.value == pytest.approx(0.014)
    assert judged(scene, 1e-3, late, late, steps=STEPS[STEPS <= 280]).right.value == pytest.approx(0.014)


def test_a_code_that_did_not_run_leaves_no_verdict(scene: Scene) -> None:
    present = Outcome(NATIVE, scene, record(scene, NATIVE, 0.0 * TIME))
    outcomes = {(NATIVE, 0): present, ("lammps", 0): Outcome("lammps", scene, None, not_run("crashed"), "not run")}
    with pytest.raises(Undefined, match=r"not-run\(crashed\)"):
        parting(scene, outcomes, NATIVE, "lammps")
    outcomes[mirror_name("lammps"), 0] = present
    (found,) = compare(scene, Gate("trajectory", "horizon", None, "absolute", 1.0, "x", None), outcomes, ("lammps",))
    assert (found.verdict, found.discrepancy) == ("not-run(crashed)", None)


def test_the_smallest_sphere_is_the_scale(scene: Scene) -> None:
    small = replace(scene, particles=(replace(scene.particles[0], radius=0.001), *scene.particles[1:]))
    outcomes = {
        (source, 0): Outcome(source, small, record(small, source, off))
        for source, off in (("lammps", 0.0 * TIME), (NATIVE, np.full(21, 1e-6)))
    }
    found = parting(small, outcomes, NATIVE, "lammps")
    assert found.diameter == 0.002
    assert "at most 0.0005 d" in describe(found)


def test_every_code_is_held_against_its_mirror_and_native() -> None:
    assert list(pairs(("yade",))) == [("native[yade]", "yade"), (NATIVE, "yade")]


def test_a_run_and_itself_never_part(tmp_path: Path) -> None:
    scene = load(BED, tmp_path).variants[0].scenes[0]
    one = engine.run(scene, tmp_path / "one")
    touched = replace(scene, particles=(replace(scene.particles[0], velocity=(0.0, 0.0, 1e-9)), *scene.particles[1:]))
    other = engine.run(touched, tmp_path / "other")
    same = {("lammps", 0): Outcome("lammps", scene, one), (NATIVE, 0): Outcome(NATIVE, scene, one)}
    assert parting(scene, same, NATIVE, "lammps").fine is None
    same[NATIVE, 0] = Outcome(NATIVE, scene, other)
    found = parting(scene, same, NATIVE, "lammps")
    assert float(found.largest[1]) / DIAMETER > 0.0
