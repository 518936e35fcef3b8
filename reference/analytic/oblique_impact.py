"""Oblique impact with Hertz, Mindlin and Coulomb friction: the native law integrated as differential equations.

A sphere i meets a plane or a sphere j in one plane of motion. With the overlap d, the approach v, the relative velocity
u along the contact, the spins w_i and w_j, the spring f and the distance r of the centres (infinite at a plane),

    d' = v,  m* v' = -N - m* u^2 / r,  m* u' = T + m* v u / r,  I_i w_i' = -a_i T,  a_i = R_i - d/2,
    N = 4/3 E* sqrt(R*) d^(3/2) + 2 sqrt(5/6) beta sqrt(S m*) v,  S = 2 E* sqrt(R* d),  k = 8 G* sqrt(R* d),
    s = u - a_i w_i - a_j w_j,  g = 2 sqrt(5/6) beta sqrt(k m*).

The contact sticks with f' = -k s, and f k'/k more while k falls (Thornton, Cummins, Cleary, *Powder Technology* 210
(2011) 189), and T = f - g s. It slides with abs(T) = mu N and f = T + g s, from the instant at which the sticking force
would pass mu N to the one at which it would fall behind it. It ends where N vanishes, because N is cut at zero.

Each stretch is integrated by the Runge-Kutta method of order 8 (Dormand, Prince; scipy's DOP853) to a relative error of
1e-12; the instants between are found as roots. Mixed values are formed here, not taken from the engine. Valid for two
bodies whose centres approach head-on or at a plane, without gravity, whose spins lie across the plane of motion.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy import integrate

from cross_check.scene import Material, Plane, Scene

Array = NDArray[np.float64]

RELATIVE_ERROR = 1e-12
# Absolute errors in units of the impact: largest overlap, speed, speed / radius, peak force.
ABSOLUTE_ERROR = 1e-14
# Overlap at the start over the largest: force and impulse before it are below rounding.
START = 1e-12
STRETCHES = 200


@dataclass(frozen=True)
class Rebound:
    """What is left after the impact, along the slip at the start and about normal x slip.

    `restitution` [-]; `tangential_velocity` of the centres [m/s], at the start and after; `spin` of the first sphere
    [rad/s]; `surface_velocity` of the contact points after [m/s]; `normal_velocity` after [m/s].
    """

    restitution: float
    start_velocity: float
    tangential_velocity: float
    spin: float
    surface_velocity: float
    normal_velocity: float


@dataclass(frozen=True)
class Impact:
    """Mixed values, SI, and the motion at the first touch; a plane has infinite radius and inertia, and no arm."""

    mass: float
    radii: tuple[float, float]
    inertia: tuple[float, float]
    young: float
    shear: float
    damping: float
    friction: float
    approach: float
    tangential: float
    spins: tuple[float, float]

    @property
    def radius(self) -> float:
        """R* [m]."""
        one, other = self.radii
        return one if math.isinf(other) else one * other / (one + other)

    @property
    def depth(self) -> float:
        """Largest overlap without damping [m]."""
        return float((15.0 * self.mass * self.approach**2 / (16.0 * self.young * math.sqrt(self.radius))) ** 0.4)

    def forces(self, state: Array) -> tuple[float, float, float, float, float]:
        """Normal force, slip, S, k, g."""
        overlap, approach, tangential, spin, other, _, _ = state
        spot = math.sqrt(self.radius * max(overlap, 0.0))
        stiff, shear = 2.0 * self.young * spot, 8.0 * self.shear * spot
        normal = 2.0 / 3.0 * stiff * overlap + self.damping * math.sqrt(stiff * self.mass) * approach
        one, two = self.arms(overlap)
        slip = tangential - one * spin - two * other
        return normal, slip, stiff, shear, self.damping * math.sqrt(shear * self.mass)

    def arms(self, overlap: float) -> tuple[float, float]:
        """From the centres to the contact [m]."""
        one, two = self.radii
        return one - 0.5 * overlap, 0.0 if math.isinf(two) else two - 0.5 * overlap

    def rates(self, state: Array, force: float, sticks: bool = True) -> Array:
        """Rates of the state under the tangential force; a spring that slides is known without its rate."""
        overlap, approach, tangential, _, _, spring, _ = state
        normal, slip, _, shear, _ = self.forces(state)
        one, two = self.arms(overlap)
        bend = 0.0 if math.isinf(self.radii[1]) else tangential / (sum(self.radii) - overlap)
        shrink = spring * approach / (2.0 * overlap) if approach < 0.0 and overlap > 0.0 else 0.0
        return np.array(
            [
                approach,
                -normal / self.mass - bend * tangential,
                force / self.mass + bend * approach,
                -one * force / self.inertia[0],
                -two * force / self.inertia[1],
                -shear * slip + shrink if sticks else 0.0,
                bend,
            ]
        )

    def lead(self, state: Array, sign: float) -> float:
        """How fast a contact that slides would pass mu N if it stuck [N/s]: negative where it begins to stick."""
        overlap, approach = float(state[0]), float(state[1])
        normal, slip, stiff, _, dashpot = self.forces(state)
        force = sign * self.friction * normal
        held = np.array(state, dtype=np.float64)
        held[5] = force + dashpot * slip
        rates = self.rates(held, force)
        one, two = self.arms(overlap)
        turned = -0.5 * approach * (state[3] + (state[4] if two else 0.0))
        slipping = float(rates[2] - one * rates[3] - two * rates[4] - turned)
        growth = approach / (4.0 * overlap)
        tested = float(rates[5]) - dashpot * (growth * slip + slipping)
        damped = self.damping * math.sqrt(stiff * self.mass) * (growth * approach + float(rates[1]))
        return sign * tested - self.friction * (stiff * approach + damped)


def _compliances(material: Material) -> tuple[float, float]:
    """(1 - nu^2) / E and 2 (2 - nu)(1 + nu) / E [1/Pa]; a rigid body has none."""
    if material.young is None or material.poisson is None:
        return 0.0, 0.0
    return (1.0 - material.poisson**2) / material.young, 2.0 * (2.0 - material.poisson) * (
        1.0 + material.poisson
    ) / material.young


def _damping_ratio(restitution: float | None, ratio: float) -> float:
    if restitution is None:
        return ratio
    return 1.0 if restitution == 0.0 else -math.log(restitution) / math.hypot(math.log(restitution), math.pi)


def impact_of(scene: Scene) -> Impact:
    """The impact of a scene of two bodies. Raises ValueError outside the range of validity."""
    sphere = scene.particles[0]
    if len(scene.particles) + len(scene.bodies) != 2 or any(scene.gravity):
        raise ValueError(f"{scene.name}: not an impact of two bodies without gravity")
    if (
        scene.model.normal.law != "hertz"
        or scene.model.tangential.law != "mindlin"
        or scene.model.moments.law != "free"
    ):
        raise ValueError(f"{scene.name}: the equations are those of hertz and mindlin")
    velocity, spins = np.array(sphere.velocity), [np.array(sphere.angular_velocity), np.zeros(3)]
    masses, radii = [4.0 / 3.0 * math.pi * sphere.radius**3 * _density(scene, 0)], [sphere.radius, math.inf]
    if len(scene.particles) == 2:
        other = scene.particles[1]
        partner = other.material
        masses.append(4.0 / 3.0 * math.pi * other.radius**3 * _density(scene, 1))
        radii[1], spins[1] = other.radius, np.array(other.angular_velocity)
        velocity = velocity - np.array(other.velocity)
        branch = np.subtract(sphere.position, other.position)
        normal = branch / np.linalg.norm(branch)
        across = velocity - float(velocity @ normal) * normal
        if float(np.linalg.norm(across)) > 0.0:
            raise ValueError(f"{scene.name}: the centres do not approach head-on")
    else:
        body = scene.bodies[0]
        if not isinstance(body.shape, Plane):
            raise ValueError(f"{scene.name}: the equations are those of a plane")
        partner, normal = body.material, np.array(body.shape.normal)
        velocity = velocity - np.array(body.motion.velocity or (0.0, 0.0, 0.0))
    pair = scene.pair(sphere.material, partner)
    if pair is None or pair.friction is None:
        raise ValueError(f"{scene.name}: the pair of the impact is not stated")
    compliances = [_compliances(scene.materials[index]) for index in (sphere.material, partner)]
    arms = [radius if math.isfinite(radius) else 0.0 for radius in radii]
    slip = velocity - float(velocity @ normal) * normal - np.cross(arms[0] * spins[0] + arms[1] * spins[1], normal)
    size = float(np.linalg.norm(slip))
    tangent = slip / size if size > 0.0 else np.zeros(3)
    axis = np.cross(normal, tangent)
    mass = masses[0] if len(masses) == 1 else masses[0] * masses[1] / sum(masses)
    return Impact(
        mass=mass,
        radii=(radii[0], radii[1]),
        inertia=(0.4 * masses[0] * radii[0] ** 2, 0.4 * masses[1] * radii[1] ** 2 if len(masses) == 2 else math.inf),
        young=1.0 / sum(normal for normal, _ in compliances),
        shear=1.0 / sum(shear for _, shear in compliances),
        damping=2.0 * math.sqrt(5.0 / 6.0) * _damping_ratio(pair.restitution, pair.damping_ratio),
        friction=pair.friction,
        approach=-float(velocity @ normal),
        tangential=float(velocity @ tangent),
        spins=(float(spins[0] @ axis), float(spins[1] @ axis)),
    )


def _density(scene: Scene, index: int) -> float:
    return scene.materials[scene.particles[index].material].density or math.nan


@functools.lru_cache(maxsize=1024)
def rebound(scene: Scene) -> Rebound:
    """The impact of a scene from first touch to the end of its force."""
    impact = impact_of(scene)
    depth, speed = impact.depth, impact.approach
    state = np.array([START * depth, speed, impact.tangential, *impact.spins, 0.0, 0.0])
    _, slip, _, shear, _ = impact.forces(state)
    # The spring at the first, small overlap: k grows with its root.
    state[5] = -2.0 / 3.0 * shear * slip * state[0] / speed
    state = _impact(impact, state, depth / speed)
    approach, tangential, spin, other, turned = (float(state[place]) for place in (1, 2, 3, 4, 6))
    along = tangential * math.cos(turned) - approach * math.sin(turned)
    away = -approach * math.cos(turned) - tangential * math.sin(turned)
    arms = [radius if math.isfinite(radius) else 0.0 for radius in impact.radii]
    return Rebound(
        restitution=away / speed,
        start_velocity=impact.tangential,
        tangential_velocity=along,
        spin=spin,
        surface_velocity=along - arms[0] * spin - arms[1] * other,
        normal_velocity=away,
    )


def _impact(impact: Impact, state: Array, unit: float) -> Array:
    """The state at the end of the force; `unit` is a time of the impact [s]."""
    force = impact.mass * impact.approach / unit
    speed, radius = impact.approach, impact.radius
    scales = np.array([impact.depth, speed, speed, speed / radius, speed / radius, force, 1.0])
    tested = _tested(impact, state)
    sign = math.copysign(1.0, tested) if abs(tested) > impact.friction * impact.forces(state)[0] else 0.0
    time = 0.0
    for _ in range(STRETCHES):
        found = cast(Any, integrate).solve_ivp(
            _rates(impact, sign),
            (time, time + 20.0 * unit),
            state,
            method="DOP853",
            rtol=RELATIVE_ERROR,
            atol=ABSOLUTE_ERROR * scales,
            max_step=0.05 * unit,
            events=[_end(impact), _change(impact, sign)],
        )
        state, time = np.array(found.y[:, -1], dtype=np.float64), float(found.t[-1])
        if found.status != 1:
            raise ArithmeticError(f"the impact does not end: {found.message}")
        if sign:
            normal, slip, _, _, dashpot = impact.forces(state)
            state[5] = sign * impact.friction * normal + dashpot * slip
        if len(found.t_events[0]):
            return state
        sign = 0.0 if sign else math.copysign(1.0, _tested(impact, state))
    raise ArithmeticError("the contact changes between sticking and sliding without end")


def _tested(impact: Impact, state: Array) -> float:
    """The tangential force of a contact that sticks [N]."""
    _, slip, _, _, dashpot = impact.forces(state)
    return float(state[5]) - dashpot * slip


def _rates(impact: Impact, sign: float) -> Callable[[float, Array], Array]:
    """Sticking (`sign` 0) or sliding with a force of that sign."""

    def rates(_: float, state: Array) -> Array:
        force = sign * impact.friction * max(impact.forces(state)[0], 0.0) if sign else _tested(impact, state)
        return impact.rates(state, force, sticks=not sign)

    return rates


def _end(impact: Impact) -> Callable[[float, Array], float]:
    """The normal force, or the overlap where only that vanishes with it."""

    def end(_: float, state: Array) -> float:
        return impact.forces(state)[0] if impact.damping > 0.0 else float(state[0])

    end.terminal, end.direction = True, -1.0  # pyright: ignore[reportFunctionMemberAccess]
    return end


def _change(impact: Impact, sign: float) -> Callable[[float, Array], float]:
    """Falls through zero where sticking turns into sliding, or sliding into sticking."""

    def change(_: float, state: Array) -> float:
        if sign:
            return impact.lead(state, sign) if state[0] > 0.0 else 1.0
        return impact.friction * impact.forces(state)[0] - abs(_tested(impact, state))

    change.terminal, change.direction = True, -1.0  # pyright: ignore[reportFunctionMemberAccess]
    return change


def tangential_velocity(scene: Scene) -> float:
    """Velocity of the centres along the slip at the start [m/s]."""
    return rebound(scene).tangential_velocity


def tangential_restitution(scene: Scene) -> float:
    """The same over that at the start [-]."""
    found = rebound(scene)
    return found.tangential_velocity / found.start_velocity


def rebound_spin(scene: Scene) -> float:
    """Spin of the first sphere about normal x slip [rad/s]."""
    return rebound(scene).spin


def rebound_tangent(scene: Scene) -> float:
    """Velocity of the contact points over the normal velocity [-]: tangent of the rebound angle."""
    found = rebound(scene)
    return found.surface_velocity / found.normal_velocity


CLOSED_FORMS = {
    "tangential_velocity": tangential_velocity,
    "tangential_restitution": tangential_restitution,
    "rebound_spin": rebound_spin,
    "rebound_tangent": rebound_tangent,
}
