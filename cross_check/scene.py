"""Scenes as the harness sees them: typed views of the JSON that the engine writes (docs/formats.md)."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, replace
from typing import Any

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Domain:
    """Box that holds every particle: corners [m] and `open` or `periodic` per axis."""

    min: Vector
    max: Vector
    boundary: tuple[str, str, str]


@dataclass(frozen=True)
class Material:
    """A material; `young` [Pa], `poisson` [-] and `density` [kg/m3] are None where `rigid`."""

    name: str
    rigid: bool
    young: float | None
    poisson: float | None
    density: float | None


@dataclass(frozen=True)
class Pair:
    """Mixed values of two materials: E* and G* [Pa], fraction of critical damping [-], restitution as asked [-]."""

    between: tuple[int, int]
    effective_young: float
    effective_shear: float | None
    damping_ratio: float
    restitution: float | None


@dataclass(frozen=True)
class NormalModel:
    """Normal law by name and whether its force is cut at zero: `on`, `off` or `default`."""

    law: str
    force_cut: str


@dataclass(frozen=True)
class Model:
    """The composed contact model."""

    normal: NormalModel


@dataclass(frozen=True)
class Mirror:
    """Engine options that reproduce another code; the plain engine has a plane without curvature, `synchronized`.

    `cylinder_curvature` is the share of its curvature that a cylinder has in R*, None for all of it.
    """

    plane_radius_factor: float | None
    start: str
    cylinder_curvature: float | None = None


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
    """`fixed`, or `prescribed` with `velocity` [m/s]."""

    kind: str
    velocity: Vector | None = None


@dataclass(frozen=True)
class Body:
    """A wall: name, index of its material, shape and motion."""

    name: str
    material: int
    shape: Shape
    motion: Motion


@dataclass(frozen=True)
class Particle:
    """A sphere at t = 0: SI units, velocities synchronized with positions."""

    material: int
    radius: float
    mass: float
    moment_of_inertia: float
    position: Vector
    velocity: Vector
    angular_velocity: Vector


@dataclass(frozen=True)
class Scene:
    """One runnable problem with nothing left to resolve."""

    schema: int
    case: str
    variant: str
    seed: int | None
    refinement: int
    level: str
    time_step: float
    steps: int
    output_every: int
    gravity: Vector
    domain: Domain
    materials: tuple[Material, ...]
    pairs: tuple[Pair, ...]
    model: Model
    mirror: Mirror
    bodies: tuple[Body, ...]
    particles: tuple[Particle, ...]

    @property
    def name(self) -> str:
        """`case/variant/seed=1`, the name of the scene in decks, reports and verdicts, without the parts it lacks."""
        return f"{self.case}/{self.member}" if self.member else self.case

    @property
    def member(self) -> str:
        """`variant/seed=1`: which of the scenes of its case it is."""
        seed = "" if self.seed is None else f"seed={self.seed}"
        return "/".join(part for part in (self.variant, seed) if part)

    def pair(self, first: int, second: int) -> Pair | None:
        """The pair of two material indices in either order, or None if the case does not state it."""
        wanted = {(first, second), (second, first)}
        return next((pair for pair in self.pairs if pair.between in wanted), None)

    def with_model(self, *, force_cut: str) -> Scene:
        """This scene with another rule for the cut of the normal force at zero."""
        return replace(self, model=Model(replace(self.model.normal, force_cut=force_cut)))

    def to_json(self) -> str:
        """The scene as the engine reads it."""
        return json.dumps(asdict(self), sort_keys=True)

    def digest(self) -> str:
        """Hash of the whole scene, hexadecimal."""
        return hashlib.blake2b(self.to_json().encode(), digest_size=16).hexdigest()


def _vector(raw: list[float]) -> Vector:
    return (float(raw[0]), float(raw[1]), float(raw[2]))


def _shape(item: dict[str, Any]) -> Shape:
    if item["kind"] == "plane":
        return Plane(_vector(item["point"]), _vector(item["normal"]))
    if item["kind"] == "cylinder":
        return Cylinder(_vector(item["point"]), _vector(item["axis"]), float(item["radius"]))
    raise ValueError(f"shape {item['kind']!r} is unknown (known: plane, cylinder)")


def _body(item: dict[str, Any]) -> Body:
    motion = item["motion"]
    velocity = motion.get("velocity")
    return Body(
        name=item["name"],
        material=item["material"],
        shape=_shape(item["shape"]),
        motion=Motion(motion["kind"], None if velocity is None else _vector(velocity)),
    )


def _particle(item: dict[str, Any]) -> Particle:
    return Particle(
        material=item["material"],
        radius=item["radius"],
        mass=item["mass"],
        moment_of_inertia=item["moment_of_inertia"],
        position=_vector(item["position"]),
        velocity=_vector(item["velocity"]),
        angular_velocity=_vector(item["angular_velocity"]),
    )


def _pair(item: dict[str, Any]) -> Pair:
    first, second = item["between"]
    typed = dict(item)
    typed["between"] = (int(first), int(second))
    return Pair(**typed)


def from_json(raw: dict[str, Any]) -> Scene:
    """The typed view of one scene object."""
    x, y, z = raw["domain"]["boundary"]
    typed: dict[str, Any] = {
        "gravity": _vector(raw["gravity"]),
        "domain": Domain(_vector(raw["domain"]["min"]), _vector(raw["domain"]["max"]), (x, y, z)),
        "materials": tuple(Material(**item) for item in raw["materials"]),
        "pairs": tuple(_pair(item) for item in raw["pairs"]),
        "model": Model(NormalModel(**raw["model"]["normal"])),
        "mirror": Mirror(**raw["mirror"]),
        "bodies": tuple(_body(item) for item in raw["bodies"]),
        "particles": tuple(_particle(item) for item in raw["particles"]),
    }
    return Scene(**{**raw, **typed})
