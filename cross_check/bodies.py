"""Walls of a scene: shapes and motions (docs/formats.md)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from cross_check.vector import Vector, vector


@dataclass(frozen=True)
class Plane:
    """A plane through `point` [m]; the unit `normal` points into the region of the particles."""

    point: Vector
    normal: Vector
    kind: str = "plane"


@dataclass(frozen=True)
class Cylinder:
    """The inside of a cylinder without end: a `point` of its axis [m], the unit `axis` and its `radius` [m]."""

    point: Vector
    axis: Vector
    radius: float
    kind: str = "cylinder"


Shape = Plane | Cylinder


@dataclass(frozen=True)
class Motion:
    """`fixed`, or `prescribed` with `velocity` [m/s]; other kinds have types of their own."""

    kind: str
    velocity: Vector | None = None


@dataclass(frozen=True)
class Load:
    """External load on a wall: a `force` [N], or a `line_stress` [N/m] on the length between two bodies, by index."""

    kind: str
    value: float
    between: tuple[int, int] | None = None


@dataclass(frozen=True, kw_only=True)
class ServoMotion(Motion):
    """`servo`: the wall has a `mass` [kg] and follows the load along the unit `direction` away from the particles.

    `damping` [kg/s] acts against its velocity.
    """

    direction: Vector
    load: Load
    mass: float
    damping: float


@dataclass(frozen=True, kw_only=True)
class OscillatingMotion(Motion):
    """`oscillating`: a sine of `amplitude` [m] and `frequency` [Hz] along the unit `direction`."""

    direction: Vector
    amplitude: float
    frequency: float


@dataclass(frozen=True)
class Body:
    """A wall: name, index of its material, shape and motion."""

    name: str
    material: int
    shape: Shape
    motion: Motion


def body_from_json(raw: dict[str, Any]) -> Body:
    """The typed view of a body."""
    shape, motion = _shape(raw["shape"]), motion_from_json(raw["motion"])
    return Body(name=raw["name"], material=raw["material"], shape=shape, motion=motion)


def body_to_json(body: Body) -> dict[str, Any]:
    """A body as the engine reads it."""
    return asdict(body) | {"motion": motion_to_json(body.motion)}


def _shape(raw: dict[str, Any]) -> Shape:
    if raw["kind"] == "plane":
        return Plane(vector(raw["point"]), vector(raw["normal"]))
    if raw["kind"] == "cylinder":
        return Cylinder(vector(raw["point"]), vector(raw["axis"]), float(raw["radius"]))
    raise ValueError(f"shape {raw['kind']!r} is unknown (known: plane, cylinder)")


def motion_from_json(raw: dict[str, Any]) -> Motion:
    """The typed view of a motion. Raises ValueError for an unknown one."""
    kind = raw["kind"]
    if kind == "fixed":
        return Motion(kind)
    if kind == "prescribed":
        return Motion(kind, vector(raw["velocity"]))
    if kind == "servo":
        load = _load(raw["load"])
        return ServoMotion(
            kind=kind, direction=vector(raw["direction"]), load=load, mass=raw["mass"], damping=raw["damping"]
        )
    if kind == "oscillating":
        direction, amplitude, frequency = vector(raw["direction"]), raw["amplitude"], raw["frequency"]
        return OscillatingMotion(kind=kind, direction=direction, amplitude=amplitude, frequency=frequency)
    raise ValueError(f"motion {kind!r} is unknown (known: fixed, prescribed, servo, oscillating)")


def _load(raw: dict[str, Any]) -> Load:
    if raw["kind"] == "force":
        return Load("force", raw["value"])
    if raw["kind"] == "line_stress":
        first, second = raw["between"]
        return Load("line_stress", raw["value"], (int(first), int(second)))
    raise ValueError(f"load {raw['kind']!r} is unknown (known: force, line_stress)")


def motion_to_json(motion: Motion) -> dict[str, Any]:
    """A motion as the engine reads it: with the values that its kind has."""
    raw = {key: value for key, value in asdict(motion).items() if value is not None}
    if isinstance(motion, ServoMotion):
        raw["load"] = {key: value for key, value in raw["load"].items() if value is not None}
    return raw
