"""Scenes as the harness sees them: typed views of the JSON that the engine writes (docs/formats.md)."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, replace
from typing import Any

from cross_check.contact_model import FREE, FRICTIONLESS, Model, NormalModel, model_from_json
from cross_check.mirror_options import Mirror, mirror_from_json, mirror_to_json, variant_to_json

__all__ = [
    "Body",
    "Domain",
    "Material",
    "Mirror",
    "Model",
    "Motion",
    "NormalModel",
    "Pair",
    "Particle",
    "Scene",
    "Shape",
    "Vector",
    "from_json",
]

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
    """Mixed values of two materials: E* and G* [Pa], fraction of critical damping [-], restitution as asked [-].

    Coefficients of friction, rolling and twisting friction [-] and work of adhesion [J/m2] are None where no law of the
    model asks for them.
    """

    between: tuple[int, int]
    effective_young: float
    effective_shear: float | None
    damping_ratio: float
    restitution: float | None
    friction: float | None = None
    rolling_friction: float | None = None
    twisting_friction: float | None = None
    work_of_adhesion: float | None = None


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
        return replace(self, model=replace(self.model, normal=replace(self.model.normal, force_cut=force_cut)))

    def to_json(self) -> str:
        """The scene as the engine reads it."""
        raw = asdict(self)
        raw["pairs"] = [_pair_to_json(pair) for pair in self.pairs]
        raw["model"] = _model_to_json(self.model)
        raw["mirror"] = mirror_to_json(self.mirror)
        return json.dumps(raw, sort_keys=True)

    def digest(self) -> str:
        """Hash of the whole scene, hexadecimal."""
        return hashlib.blake2b(self.to_json().encode(), digest_size=16).hexdigest()


# Values of a pair that stand only where a law asks for them.
_OPTIONAL = ("friction", "rolling_friction", "twisting_friction", "work_of_adhesion")


def _pair_to_json(pair: Pair) -> dict[str, Any]:
    return {key: value for key, value in asdict(pair).items() if key not in _OPTIONAL or value is not None}


def _model_to_json(model: Model) -> dict[str, Any]:
    """The laws; a frictionless or free one is not stated."""
    raw = asdict(model)
    if model.tangential == FRICTIONLESS:
        del raw["tangential"]
    if model.moments == FREE:
        del raw["moments"]
    elif "stiffness" in raw["moments"]:
        parts = {name: variant_to_json(raw["moments"][name]) for name in ("stiffness", "dashpot", "twisting")}
        raw["moments"] |= parts
    return raw


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
        "model": model_from_json(raw["model"]),
        "mirror": mirror_from_json(raw["mirror"]),
        "bodies": tuple(_body(item) for item in raw["bodies"]),
        "particles": tuple(_particle(item) for item in raw["particles"]),
    }
    return Scene(**{**raw, **typed})
