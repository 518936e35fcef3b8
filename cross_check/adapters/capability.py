"""What the translations to all external codes ask of a scene before they look at it one by one."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from cross_check.adapters.interface import InvalidScene, NotComparable, Row
from cross_check.adapters.render import number, numbers, word
from cross_check.scene import Body, Cylinder, Mirror, Pair, Scene, Vector

AXES = "xyz"
# Young's modulus [Pa] typed for a rigid material: (1 - nu^2)/E vanishes beside every real material, to the last bit.
RIGID_YOUNG = 1e40
# Actions of stages that no translation has; `strain` is a motion.
NATIVE_ACTIONS = ("remove", "ramp_temperature", "set_relaxation_time")
# Relative tolerance for values that the scene and the code both form from the same inputs: rounding only.
SAME = 1e-12


@dataclass(frozen=True)
class Plane:
    """A plane normal to an axis: body index, axis 0-2, side +1 or -1 of the particles, position [m], velocity [m/s]."""

    index: int
    name: str
    material: int
    axis: int
    side: int
    position: float
    velocity: Vector


@dataclass(frozen=True)
class Tube:
    """The inside of a cylinder along an axis: body index, axis 0-2, `place` in the other coordinates in order [m].

    `radius` [m], `velocity` [m/s].
    """

    index: int
    name: str
    material: int
    axis: int
    place: tuple[float, float]
    radius: float
    velocity: Vector


def native_only(scene: Scene) -> list[str]:
    """What a scene states, apart from its laws, and only the native engine computes: one reason each."""
    reasons: list[str] = []
    if scene.start is not None:
        reasons.append(f"the scene starts from a state of the case {scene.start.scene.case}, contacts and all")
    if scene.disk_height is not None:
        reasons.append("particles are disks, the codes have spheres")
    if scene.temperature is not None or any(material.expansion is not None for material in scene.materials):
        reasons.append("the particles have a temperature")
    moving = [(name, kind) for name, kind in scene.motions() if kind not in ("fixed", "prescribed")]
    for motion in dict.fromkeys(kind for _, kind in moving):
        names = ", ".join(dict.fromkeys(name for name, kind in moving if kind == motion))
        reasons.append(f"the motion {motion} of {names} has no translation")
    done = (action.do for stage in scene.stages for action in stage.actions)
    reasons += [f"the action {name} has no translation" for name in dict.fromkeys(done) if name in NATIVE_ACTIONS]
    if any(stage.output_every not in (None, scene.output_every) for stage in scene.stages):
        reasons.append("samples of a stage at intervals of its own have no translation")
    return reasons


def check(scene: Scene) -> None:
    """Raises InvalidScene for a scene that no code can run, NotComparable for particles that no translation has."""
    for name in (scene.name, *(m.name for m in scene.materials), *(b.name for b in scene.bodies)):
        word(name)
    if scene.steps <= 0 or scene.output_every <= 0 or scene.steps % scene.output_every:
        raise InvalidScene(
            f"steps {scene.steps} is not a positive multiple of output_every {scene.output_every}: "
            "the last sample would not be the last step"
        )
    if not scene.time_step > 0:
        raise InvalidScene(f"time_step {scene.time_step!r} is not positive")
    if not scene.particles:
        raise InvalidScene("the scene has no particles")
    for boundary in scene.domain.boundary:
        if boundary not in ("open", "periodic"):
            raise InvalidScene(f"boundary {boundary!r} is unknown (known: open, periodic)")
    _check_particles(scene)


def _check_particles(scene: Scene) -> None:
    low, high = scene.domain.min, scene.domain.max
    for index, particle in enumerate(scene.particles):
        where = f"particles[{index}]"
        if not (particle.radius > 0 and particle.mass > 0):
            raise InvalidScene(f"{where}: radius and mass must be positive")
        if scene.materials[particle.material].rigid:
            raise NotComparable(f"{where} is of a rigid material: a code needs its Young's modulus")
        sphere = 0.4 * particle.mass * particle.radius**2
        if abs(particle.moment_of_inertia - sphere) > SAME * sphere:
            raise NotComparable(f"{where} has a moment of inertia that is not 2/5 m R^2, the only one of the code")
        if not all(a <= x <= b for a, x, b in zip(low, particle.position, high, strict=True)):
            raise InvalidScene(f"{where} lies outside of the domain")


def walls(scene: Scene) -> list[Plane | Tube]:
    """The bodies as planes normal to an axis and tubes along one. Raises NotComparable for any other body."""
    return [
        _tube(scene, i, b) if isinstance(b.shape, Cylinder) else _plane(scene, i, b) for i, b in enumerate(scene.bodies)
    ]


def planes(scene: Scene, no_tubes: str) -> list[Plane]:
    """The bodies as planes normal to an axis, for a code that has no other; `no_tubes` says why."""
    result: list[Plane] = []
    for wall in walls(scene):
        if isinstance(wall, Tube):
            raise NotComparable(f"body {wall.name}: {no_tubes}")
        result.append(wall)
    return result


def _plane(scene: Scene, index: int, body: Body) -> Plane:
    if isinstance(body.shape, Cylinder):
        raise InvalidScene(f"body {body.name} is no plane")
    normal = body.shape.normal
    axis = _axis(normal)
    if axis is None:
        raise NotComparable(f"body {body.name}: only planes whose normal lies along x, y or z have a translation")
    if scene.domain.boundary[axis] == "periodic":
        raise InvalidScene(f"body {body.name} is normal to {AXES[axis]}, along which the domain is periodic")
    side = 1 if normal[axis] > 0 else -1
    return Plane(index, body.name, body.material, axis, side, body.shape.point[axis], _velocity(body))


def _tube(scene: Scene, index: int, body: Body) -> Tube:
    if not isinstance(body.shape, Cylinder):
        raise InvalidScene(f"body {body.name} is no cylinder")
    axis = _axis(body.shape.axis)
    if axis is None:
        raise NotComparable(f"body {body.name}: only cylinders along x, y or z have a translation")
    others = [other for other in range(3) if other != axis]
    across = next((other for other in others if scene.domain.boundary[other] == "periodic"), None)
    if across is not None:
        raise InvalidScene(f"body {body.name} is a cylinder across {AXES[across]}, along which the domain is periodic")
    place = (body.shape.point[others[0]], body.shape.point[others[1]])
    return Tube(index, body.name, body.material, axis, place, body.shape.radius, _velocity(body))


def _axis(direction: Vector) -> int | None:
    """The axis along which a unit vector lies, or None."""
    axes = [axis for axis in range(3) if direction[axis] != 0.0]
    return axes[0] if len(axes) == 1 and abs(direction[axes[0]]) == 1.0 else None


def _velocity(body: Body) -> Vector:
    """Velocity [m/s] of a body whose motion has a translation: others are `native_only`."""
    return body.motion.velocity or (0.0, 0.0, 0.0)


def touching(scene: Scene) -> list[Pair]:
    """The pairs of materials that can touch in this scene, ordered; a pair without values is an InvalidScene."""
    count = [0] * len(scene.materials)
    for particle in scene.particles:
        count[particle.material] += 1
    used = [index for index, number_of in enumerate(count) if number_of]
    wanted = {(i, j) for i in used for j in used if i < j or (i == j and count[i] > 1)}
    wanted |= {(min(i, body.material), max(i, body.material)) for i in used for body in scene.bodies}
    result: list[Pair] = []
    for i, j in sorted(wanted):
        pair = scene.pair(i, j)
        if pair is None:
            raise InvalidScene(f"pairs: no values for {scene.materials[i].name} with {scene.materials[j].name}")
        if pair.damping_ratio < 0 or not pair.effective_young > 0:
            raise InvalidScene(f"{pair_key(scene, pair)}: damping_ratio >= 0 and effective_young > 0 are allowed")
        result.append(replace(pair, between=(i, j)))
    return result


def head_on(scene: Scene) -> bool:
    """Whether nothing can slip: one or two bodies that approach along their normal, without spin and weight."""
    if len(scene.particles) + len(scene.bodies) != 2 or any(scene.gravity):
        return False
    if any(any(particle.angular_velocity) for particle in scene.particles):
        return False
    first = scene.particles[0]
    if scene.bodies:
        body = scene.bodies[0]
        if isinstance(body.shape, Cylinder):
            return False
        normal, other = body.shape.normal, body.motion.velocity or (0.0, 0.0, 0.0)
    else:
        second = scene.particles[1]
        x, y, z = (a - b for a, b in zip(first.position, second.position, strict=True))
        normal, other = (x, y, z), second.velocity
    u, v, w = (a - b for a, b in zip(first.velocity, other, strict=True))
    x, y, z = normal
    return y * w == z * v and z * u == x * w and x * v == y * u


def pair_key(scene: Scene, pair: Pair) -> str:
    """`pairs.A+B`, the name of a pair in translations and messages."""
    return "pairs." + "+".join(scene.materials[index].name for index in pair.between)


def stiffness_of(scene: Scene, material: int) -> tuple[float, float]:
    """Young's modulus [Pa] and Poisson's ratio [-] to type for a material; a rigid one has 1/E = 0."""
    entry = scene.materials[material]
    if entry.rigid:
        return RIGID_YOUNG, 0.0
    if entry.young is None or entry.poisson is None:
        raise InvalidScene(f"material {entry.name} is not rigid and lacks young or poisson")
    return entry.young, entry.poisson


def check_effective_young(scene: Scene, pair: Pair, code: str) -> None:
    """Raises NotComparable where a code that forms E* from its materials would not get the E* of the scene."""
    compliance = 0.0
    for index in pair.between:
        young, poisson = stiffness_of(scene, index)
        compliance += (1.0 - poisson**2) / young
    if abs(pair.effective_young * compliance - 1.0) > SAME:
        raise NotComparable(
            f"{code} forms E* = {number(1.0 / compliance)} Pa from the two materials of {pair_key(scene, pair)}, "
            f"the scene states {number(pair.effective_young)} Pa"
        )


def resolved_cut(scene: Scene, default: str) -> str:
    """`on` or `off`: what the scene says, or what the code does when nothing is said."""
    return default if scene.model.normal.force_cut == "default" else scene.model.normal.force_cut


def mirrored(scene: Scene, cut: str, mirror: Mirror) -> Scene:
    """The scene with the cut at zero resolved and the engine options of a mirror."""
    return replace(scene.with_model(force_cut=cut), mirror=mirror)


def has_tube(scene: Scene) -> bool:
    """Whether a body is a cylinder, whose curvature a mirror then states."""
    return any(isinstance(body.shape, Cylinder) for body in scene.bodies)


def gravity(scene: Scene) -> tuple[float, Vector]:
    """Magnitude [m/s2] and direction [-] of gravity, exact along an axis; downwards where there is none."""
    x, y, z = scene.gravity
    size = math.hypot(x, y, z) if sum(g != 0.0 for g in scene.gravity) > 1 else abs(x + y + z)
    return (size, (x / size, y / size, z / size)) if size > 0 else (0.0, (0.0, 0.0, -1.0))


def shared_rows(scene: Scene, time_step_key: str, gravity: tuple[str, str, str]) -> list[Row]:
    """Rows that every code has: time step, and gravity with the key, value and formula of the code."""
    step = number(scene.time_step)
    return [
        Row("time_step", step, time_step_key, step, "s", "as stated"),
        Row("gravity", numbers(scene.gravity), gravity[0], gravity[1], "m/s2", gravity[2]),
    ]
