"""Observables of records: interpolation between samples, and records that do not define them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cross_check.compare.quantities import QUANTITIES, Undefined, contact_duration, peak_force, restitution
from cross_check.record import Array, Code, Header, RunRecord
from cross_check.reference import thin
from cross_check.scene import Scene
from cross_check.suites import named

SCENE = named("chung-ooi-2").variants[0].scenes[0]
RADIUS, MASS = SCENE.particles[0].radius, SCENE.particles[0].mass


def record(overlap: Array, speed: Array, force: Array, dt: float, velocity_time: str = "synchronized") -> RunRecord:
    """A sphere over the floor of SCENE, all values of shape (T,)."""
    samples = len(overlap)

    def column(values: Array) -> Array:
        filled = np.zeros((samples, 1, 3))
        filled[:, 0, 2] = values
        return filled

    velocity = column(-speed)
    if velocity_time == "half_step":
        velocity = velocity + 0.5 * dt * column(force) / MASS
    step = np.arange(samples)
    header = Header(
        source="test", case="c", variant="v", seed=None, refinement=0, code=Code("test", "0", "none"), deck_hash="",
        machine="", wall_time=0.0, time_step=dt, steps=samples - 1, velocity_time=velocity_time, contact_force="exact",
        mass=[MASS], radius=[RADIUS], bodies=["floor"], gravity=[0.0, 0.0, 0.0],
    )  # fmt: skip
    columns = {
        "step": step,
        "time": step * dt,
        "position": column(RADIUS - overlap),
        "velocity": velocity,
        "angular_velocity": np.zeros((samples, 1, 3)),
        "force": column(force),
        "torque": np.zeros((samples, 1, 3)),
    }
    return RunRecord(header, columns)


def impact(onset: float, rebound: float, dt: float = 1.0, velocity_time: str = "synchronized") -> RunRecord:
    """A contact of half a sine over 100 time units that begins at `onset` and leaves with `rebound` times 1e-5."""
    time = np.arange(160) * dt - onset
    inside = (time > 0.0) & (time < 100.0)
    speed = np.where(time <= 0.0, 1e-5, np.where(time >= 100.0, -rebound * 1e-5, 0.0))
    overlap = np.where(
        inside, 1e-4 * np.sin(np.pi * time / 100.0), np.where(time <= 0.0, time, rebound * (100.0 - time)) * 1e-5
    )
    force = np.where(inside, 7.0 * np.sin(np.pi * time / 100.0), 0.0)
    return record(overlap, speed, force, dt, velocity_time)


@settings(max_examples=30, deadline=None)
@given(onset=st.floats(5.01, 30.99), rebound=st.floats(0.1, 1.0))
def test_events_between_samples_are_interpolated(onset: float, rebound: float) -> None:
    run = impact(onset, rebound)
    assert contact_duration(SCENE, run) == pytest.approx(100.0, rel=1e-9)
    assert restitution(SCENE, run) == pytest.approx(rebound, rel=1e-9)
    assert peak_force(SCENE, run) == pytest.approx(7.0, rel=1e-6)


def test_half_step_velocities_are_synchronized() -> None:
    plain, staggered = impact(10.3, 0.7), impact(10.3, 0.7, velocity_time="half_step")
    assert not np.allclose(plain["velocity"], staggered["velocity"], rtol=0, atol=1e-9)
    assert np.allclose(plain["velocity"], staggered.synchronized_velocity(), rtol=0, atol=1e-20)


@settings(max_examples=20, deadline=None)
@given(onset=st.floats(5.01, 30.99), rebound=st.floats(0.1, 1.0))
def test_a_stored_record_has_the_quantities_of_the_full_one(onset: float, rebound: float) -> None:
    full = impact(onset, rebound)
    stored = thin(full, samples=20)
    assert len(stored.step) < len(full.step)
    for name in ("peak_force", "contact_duration", "restitution"):
        scalar = QUANTITIES[name].scalar
        assert scalar is not None
        assert scalar(SCENE, stored) == scalar(SCENE, full)


def test_bodies_that_never_touch_or_never_part_have_no_restitution() -> None:
    run = impact(10.3, 0.7)
    for cut, reason in ((slice(0, 8), "never touch"), (slice(0, 60), "still touch"), (slice(40, 160), "first sample")):
        part = RunRecord(run.header, {name: column[cut] for name, column in run.columns.items()})
        with pytest.raises(Undefined, match=reason):
            restitution(SCENE, part)


def test_a_bed_is_not_an_impact() -> None:
    crowd: Scene = replace(SCENE, particles=SCENE.particles * 3)
    with pytest.raises(Undefined, match="two bodies"):
        peak_force(crowd, impact(10.3, 0.7))
