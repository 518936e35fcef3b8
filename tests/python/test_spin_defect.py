"""The quantity `spin_defect`: change of spin against the impulse of the force at the arm of the law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cross_check.compare.oblique import spin_defect
from cross_check.compare.quantities import Undefined
from cross_check.mirror_options import Arms, Mirror, TangentialOptions
from cross_check.record import Code, Header, RunRecord
from cross_check.scene import Scene
from cross_check.suites import named

SCENE = named("chung-ooi-4").variants[0].scenes[0]
BALL = SCENE.particles[0]
DT = 1e-7
SAMPLES = 200
# Share of the radius by which the sphere overlaps the plane at most: the arms then differ by as much.
DEPTH = 0.02
MID, SURFACE, RADIUS = (Arms(arm, arm) for arm in ("mid_overlap", "surface", "radius"))


def mirrored(arms: Arms) -> Scene:
    """The scene with other arms at planes."""
    options = TangentialOptions(
        "force", "small_angles", "rotate_first", "present", "elastic", "total", pair_arms=MID, wall_arms=arms
    )
    return replace(SCENE, mirror=Mirror(None, "synchronized", tangential=options))


def impact(arm: float, velocity_time: str = "synchronized", gain: float = 1.0) -> RunRecord:
    """A sphere that a tangential force spins up with the arm R - `arm` d; `gain` times what it should."""
    phase = np.linspace(-0.1, 1.1, SAMPLES) * np.pi
    overlap = DEPTH * BALL.radius * np.sin(phase)
    inside = overlap > 0.0
    force = np.zeros((SAMPLES, 1, 3))
    force[:, 0, 2] = np.where(inside, 10.0 * overlap / overlap.max(), 0.0)
    force[:, 0, 0] = -0.3 * force[:, 0, 2]
    # The contact lies at -z: (0, 0, -a) x f has the y component -a f_x.
    torque = -(BALL.radius - arm * overlap) * force[:, 0, 0]
    kicks = torque[1:] if velocity_time == "half_step" else 0.5 * (torque[1:] + torque[:-1])
    spin = np.zeros((SAMPLES, 1, 3))
    spin[1:, 0, 1] = gain * np.cumsum(DT * kicks) / BALL.moment_of_inertia
    position = np.zeros((SAMPLES, 1, 3))
    position[:, 0, 2] = BALL.radius - overlap
    header = Header(
        source="test", case="c", variant="v", seed=None, refinement=0, code=Code("test", "0", "none"), deck_hash="",
        machine="", wall_time=0.0, time_step=DT, steps=SAMPLES - 1, velocity_time=velocity_time, contact_force="exact",
        mass=[BALL.mass], radius=[BALL.radius], bodies=["floor"], gravity=[0.0, 0.0, 0.0],
    )  # fmt: skip
    step = np.arange(SAMPLES)
    columns = {
        "step": step, "time": step * DT, "position": position, "velocity": np.zeros((SAMPLES, 1, 3)),
        "angular_velocity": spin, "force": force, "torque": np.zeros((SAMPLES, 1, 3)),
    }  # fmt: skip
    return RunRecord(header, columns)


@pytest.mark.parametrize("velocity_time", ["synchronized", "half_step"])
@pytest.mark.parametrize(("arms", "share"), [(MID, 0.5), (SURFACE, 1.0), (RADIUS, 0.0)])
def test_a_spin_that_the_law_made_has_no_defect(arms: Arms, share: float, velocity_time: str) -> None:
    assert spin_defect(mirrored(arms), impact(share, velocity_time)) < 1e-14


def test_plain_native_has_arms_to_the_middle_of_the_overlap() -> None:
    assert spin_defect(SCENE, impact(0.5)) < 1e-14
    assert spin_defect(SCENE, impact(0.0)) > 1e-3


@pytest.mark.parametrize(("arms", "share"), [(MID, 1.0), (SURFACE, 0.5), (RADIUS, 0.5)])
def test_another_arm_shows_by_half_the_mean_overlap(arms: Arms, share: float) -> None:
    # The overlap weighted by the force: the mean of sin^2 over that of sin is pi/4.
    expected = 0.5 * DEPTH * np.pi / 4.0
    assert spin_defect(mirrored(arms), impact(share)) == pytest.approx(expected, rel=0.02)


def test_the_defect_is_relative_to_the_impulse() -> None:
    assert spin_defect(SCENE, impact(0.5, gain=1.003)) == pytest.approx(3e-3, rel=1e-9)


def test_a_thinned_record_is_judged_on_its_neighbouring_steps() -> None:
    whole = impact(0.5)
    kept = [*range(0, 60, 10), *range(60, 80), *range(80, SAMPLES, 10)]
    thinned = RunRecord(whole.header, {name: column[kept] for name, column in whole.columns.items()})
    assert spin_defect(SCENE, thinned) < 1e-14
    thinned["angular_velocity"][kept.index(70) :, 0, 1] += 1e-3
    assert spin_defect(SCENE, thinned) > 1e-6


def test_records_without_a_torque_on_neighbouring_steps_do_not_define_it() -> None:
    whole = impact(0.5)
    every_other = RunRecord(whole.header, {name: column[::2] for name, column in whole.columns.items()})
    with pytest.raises(Undefined, match="no torque acts on neighbouring steps"):
        spin_defect(SCENE, every_other)
