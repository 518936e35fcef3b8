"""A sphere on a horizontal plane under its weight: sliding into rolling, and rolling and twisting friction.

With the arm a = R - d/2 at the overlap d of rest, 4/3 E* sqrt(R) d^(3/2) = m g, and the inertia I = 2/5 m R^2:

- launched with v0 and no spin, it slides with the force mu m g until t = v0 / (mu g (1 + m a^2 / I)) and rolls with
  v0 / (1 + I / (m a^2)), which is 5/7 v0 and 2 v0 / (7 mu g) for a = R;
- rolling freely under a moment M it slows by M / (m a (1 + I / (m a^2))), which is 5/7 mu_r g for M = mu_r m g R;
- spinning about the normal under a moment M it slows by M / I, which is 5/2 mu_r g / R for M = mu_r m g R.

Mechanics of rigid bodies (Lamb, *Dynamics*, 1914, section 65). Valid once the normal motion has died away.
"""

from __future__ import annotations

import math

from cross_check.contact_model import ElasticPlasticRolling
from cross_check.scene import Pair, Scene


def _gravity(scene: Scene) -> float:
    return math.hypot(*scene.gravity)


def _pair(scene: Scene) -> Pair:
    pair = scene.pair(scene.particles[0].material, scene.bodies[0].material)
    if pair is None:
        raise ValueError(f"{scene.name}: the pair of the sphere and the plane is not stated")
    return pair


def _overlap(scene: Scene) -> float:
    """Overlap of rest [m]."""
    sphere = scene.particles[0]
    material = scene.materials[sphere.material]
    if material.young is None or material.poisson is None:
        raise ValueError(f"{scene.name}: the sphere is rigid")
    modulus = material.young / (1.0 - material.poisson**2)
    weight = sphere.mass * _gravity(scene)
    return float((weight / (4.0 / 3.0 * modulus * math.sqrt(sphere.radius))) ** (2.0 / 3.0))


def _arm(scene: Scene) -> float:
    return scene.particles[0].radius - 0.5 * _overlap(scene)


def _share(scene: Scene) -> float:
    """I / (m a^2) [-]."""
    return 0.4 * (scene.particles[0].radius / _arm(scene)) ** 2


def _coefficient(value: float | None) -> float:
    if value is None:
        raise ValueError("the pair lacks a coefficient of friction")
    return value


def rolling_velocity(scene: Scene) -> float:
    """Speed of a launched sphere that has come to roll [m/s]."""
    return math.hypot(*scene.particles[0].velocity) / (1.0 + _share(scene))


def sliding_time(scene: Scene) -> float:
    """Time at which a launched sphere begins to roll [s]."""
    speed = math.hypot(*scene.particles[0].velocity)
    return speed / (_coefficient(_pair(scene).friction) * _gravity(scene) * (1.0 + 1.0 / _share(scene)))


def rolling_deceleration(scene: Scene) -> float:
    """Deceleration of a sphere that rolls freely under the moment mu_r m g R [m/s2]."""
    moment = _coefficient(_pair(scene).rolling_friction) * _gravity(scene) * scene.particles[0].radius
    return moment / (_arm(scene) * (1.0 + _share(scene)))


def twisting_deceleration(scene: Scene) -> float:
    """Rate at which the spin about the normal falls under the largest twisting moment of the model [rad/s2]."""
    law, pair, radius = scene.model.moments, _pair(scene), scene.particles[0].radius
    if not isinstance(law, ElasticPlasticRolling):
        raise ValueError(f"{scene.name}: the model does not twist")
    twisting = law.twisting
    if twisting.kind == "joint":
        length = _coefficient(pair.rolling_friction) * radius
    elif twisting.kind == "spot":
        length = 2.0 / 3.0 * math.sqrt(radius * _overlap(scene)) * _coefficient(pair.twisting_friction)
    elif twisting.arm is not None:
        length = twisting.arm * _coefficient(pair.twisting_friction)
    else:
        raise ValueError(f"{scene.name}: the twisting moment has no limit")
    return length * _gravity(scene) / (0.4 * radius**2)


CLOSED_FORMS = {
    "rolling_velocity": rolling_velocity,
    "sliding_time": sliding_time,
    "rolling_deceleration": rolling_deceleration,
    "twisting_deceleration": twisting_deceleration,
}
