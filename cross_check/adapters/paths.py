"""Prescribed paths as formulas of the step number, in words that the codes and Python share: sin, cos, + - *.

The formulas are those of `src/path.rs`, with everything but the step evaluated: places at a step, and the mean velocity
over the step that ends there. An angular velocity is a number where it is constant over a stage.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.render import number
from cross_check.scene import Drive, Leg, Scene, Vector

ZERO: Vector = (0.0, 0.0, 0.0)
# A factor and the function of the step that it multiplies; no name stands for 1.
Factor = tuple[float, str]
Term = tuple[Vector, list[Factor]]
Formulas = tuple[str, str, str]


@dataclass(frozen=True)
class Stage:
    """One stage of a path: its last step, formulas of place [m], velocity [m/s] and angular velocity [rad/s].

    `spin` is the angular velocity [rad/s] where it is constant, else None.
    """

    last: int
    place: Formulas
    velocity: Formulas
    angular_velocity: Formulas
    spin: Vector | None


def stages(scene: Scene, drive: Drive, origin: Vector) -> list[Stage]:
    """The stages of a driven particle; places are measured from `origin` [m]."""
    found: list[Stage] = []
    first = 0
    for leg in drive.legs:
        found.append(_stage(leg, first, scene.time_step, origin))
        first += leg.steps
    return found


def constant_spins(scene: Scene, code: str) -> None:
    """Raises NotComparable for an angular velocity that changes within a stage."""
    for drive in scene.drives:
        if any(_spin(leg) is None for leg in drive.legs):
            raise NotComparable(
                f"particle {drive.particle}: {code} drives angular velocities that are constant over a stage, "
                "not this one"
            )


def rows(scene: Scene, code_key: str) -> list[Row]:
    """The translation of the paths."""
    formula = "formulas of the step, stage by stage"
    return [
        Row(f"drives.{drive.particle}", f"{len(drive.legs)} stages", code_key, "below", "m, m/s", formula)
        for drive in scene.drives
    ]


def stage_steps(scene: Scene) -> list[int]:
    """Number of steps of every stage; the whole run where nothing is driven."""
    return [leg.steps for leg in scene.drives[0].legs] if scene.drives else [scene.steps]


def free(scene: Scene) -> list[int]:
    """Indices of the particles that nothing drives."""
    driven = {drive.particle for drive in scene.drives}
    return [index for index in range(len(scene.particles)) if index not in driven]


def move_stages(scene: Scene) -> list[dict[str, object]]:
    """Every stage in the words of `fix move variable`: atom ids, formulas that they follow, angular velocities, steps.

    Places are displacements from the start, as that fix has them.
    """
    found: list[dict[str, object]] = []
    paths = [(drive, stages(scene, drive, scene.particles[drive.particle].position)) for drive in scene.drives]
    for index, steps in enumerate(stage_steps(scene)):
        moves = [
            {
                "id": drive.particle + 1,
                "variables": list(zip("xyzuvw", [*legs[index].place, *legs[index].velocity], strict=True)),
                "spin": [number(value) for value in legs[index].spin or ZERO],
            }
            for drive, legs in paths
        ]
        found.append({"steps": steps, "moves": moves})
    return found


def _scaled(vector: Vector, factor: float) -> Vector:
    return (vector[0] * factor, vector[1] * factor, vector[2] * factor)


def _minus(left: Vector, right: Vector) -> Vector:
    return (left[0] - right[0], left[1] - right[1], left[2] - right[2])


def _plus(left: Vector, right: Vector) -> Vector:
    return (left[0] + right[0], left[1] + right[1], left[2] + right[2])


def _cross(left: Vector, right: Vector) -> Vector:
    (a, b, c), (x, y, z) = left, right
    return (b * z - c * y, c * x - a * z, a * y - b * x)


def _since(first: int, late: bool) -> str:
    """Steps since the beginning of a stage, at the end of the present step or (`late` is false) in its middle."""
    shift = number(float(first)) if late else number(first + 0.5)
    return f"(step-{shift})"


def _course(leg: Leg, first: int, dt: float) -> tuple[Factor, Factor, Factor]:
    """Mean of the course over a step [-], mean of its integral at both ends, its integral at the end [s]."""
    middle, end = _since(first, late=False), _since(first, late=True)
    if leg.course.kind == "constant":
        return (1.0, ""), (dt, middle), (dt, end)
    rate = 2.0 * math.pi * (leg.course.frequency or 0.0)
    half, pace = 0.5 * rate * dt, number(rate * dt)
    return (
        (math.sin(half) / half, f"cos({pace}*{middle})"),
        (math.cos(half) / rate, f"sin({pace}*{middle})"),
        (1.0 / rate, f"sin({pace}*{end})"),
    )


def _formulas(terms: list[Term]) -> Formulas:
    """The sum of vectors times factors, axis by axis."""

    def axis(at: int) -> str:
        text = ""
        for vector, factors in terms:
            value = vector[at]
            names = [name for _, name in factors if name]
            for factor, _ in factors:
                value *= factor
            if value == 0.0:
                continue
            sign = "-" if value < 0 else "+" if text else ""
            text += sign + "*".join([number(abs(value)), *names])
        return text or "0"

    return (axis(0), axis(1), axis(2))


def _stage(leg: Leg, first: int, dt: float, origin: Vector) -> Stage:
    mean, between, integral = _course(leg, first, dt)
    rate = math.sqrt(sum(component**2 for component in leg.rotation))
    last = first + leg.steps
    if rate == 0.0:
        return Stage(
            last,
            _formulas([(_minus(leg.position, origin), []), (leg.velocity, [integral])]),
            _formulas([(leg.velocity, [mean])]),
            _formulas([(leg.angular_velocity, [mean])]),
            _spin(leg),
        )
    axis = _scaled(leg.rotation, 1.0 / rate)
    arm = _minus(leg.position, leg.point)
    parts = [_parts(vector, axis) for vector in (arm, leg.velocity, leg.angular_velocity)]
    (arm_along, arm_across, arm_turned), (along, across, turned), spin = parts
    half, pace = 0.5 * rate * dt, number(rate * dt)
    end, middle = _since(first, late=True), _since(first, late=False)
    cos_end, sin_end = (1.0, f"cos({pace}*{end})"), (1.0, f"sin({pace}*{end})")
    cos_middle, sin_middle = (1.0, f"cos({pace}*{middle})"), (1.0, f"sin({pace}*{middle})")
    chord, tilt = (2.0 * math.sin(half) / dt, ""), (math.cos(half), "")
    back = (-2.0 * math.sin(half) / dt, "")
    place: list[Term] = [
        (_minus(_plus(leg.point, arm_along), origin), []),
        (arm_across, [cos_end]),
        (arm_turned, [sin_end]),
        (along, [integral]),
        (across, [integral, cos_end]),
        (turned, [integral, sin_end]),
    ]
    velocity: list[Term] = [
        (arm_turned, [chord, cos_middle]),
        (arm_across, [back, sin_middle]),
        (turned, [chord, between, cos_middle]),
        (across, [back, between, sin_middle]),
        (along, [mean]),
        (across, [tilt, mean, cos_middle]),
        (turned, [tilt, mean, sin_middle]),
    ]
    angular: list[Term] = [
        (leg.rotation, []),
        (spin[0], [mean]),
        (spin[1], [mean, cos_middle]),
        (spin[2], [mean, sin_middle]),
    ]
    return Stage(last, _formulas(place), _formulas(velocity), _formulas(angular), _spin(leg))


def _parts(vector: Vector, axis: Vector) -> tuple[Vector, Vector, Vector]:
    """The part along an axis, the part across it, and that part turned by a right angle."""
    size = sum(a * b for a, b in zip(axis, vector, strict=True))
    along = _scaled(axis, size)
    return along, _minus(vector, along), _cross(axis, vector)


def _spin(leg: Leg) -> Vector | None:
    """The angular velocity [rad/s] of a leg if it is constant, else None."""
    steady = leg.course.kind == "constant" and _cross(leg.rotation, leg.angular_velocity) == ZERO
    if leg.angular_velocity != ZERO and not steady:
        return None
    return _plus(leg.angular_velocity, leg.rotation)
