"""Scenes as the harness sees them: typed views of the JSON that the engine writes (docs/formats.md)."""

from __future__ import annotations

import hashlib
import itertools
import json
from dataclasses import asdict, dataclass, replace
from typing import Any

from cross_check.contact_model import FREE, FRICTIONLESS, Model, NormalModel, model_from_json
from cross_check.mirror_options import Mirror, mirror_from_json, mirror_to_json, variant_to_json

__all__ = [
    "Action",
    "Body",
    "Course",
    "Domain",
    "Drive",
    "Leg",
    "Material",
    "Mirror",
    "Model",
    "Motion",
    "NormalModel",
    "Pair",
    "Particle",
    "Scene",
    "SetGravity",
    "SetMotion",
    "SetPair",
    "Shape",
    "Stage",
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
class Course:
    """What multiplies the velocities of a leg: `constant`, or `sinusoid` with a `frequency` [Hz], which is a cosine."""

    kind: str
    frequency: float | None = None


@dataclass(frozen=True)
class Leg:
    """One stage of a path (`src/path.rs`): place at its beginning [m], velocities [m/s, rad/s], rotation and point."""

    steps: int
    position: Vector
    velocity: Vector
    angular_velocity: Vector
    course: Course
    rotation: Vector
    point: Vector


@dataclass(frozen=True)
class Drive:
    """The path of a driven particle: its index and one leg per stage of the case."""

    particle: int
    legs: tuple[Leg, ...]


@dataclass(frozen=True)
class SetPair:
    """Gives a pair of materials new values."""

    pair: Pair
    do: str = "set_pair"


@dataclass(frozen=True)
class SetMotion:
    """Gives a body, by index, another motion."""

    body: int
    motion: Motion
    do: str = "set_motion"


@dataclass(frozen=True)
class SetGravity:
    """Changes gravity [m/s2]."""

    value: Vector
    do: str = "set_gravity"


Action = SetPair | SetMotion | SetGravity


@dataclass(frozen=True)
class Stage:
    """A part of the run: its name, number of steps, and what changes at its beginning.

    Actions take effect after the sample of the step at which the stage begins, before the next step.
    """

    name: str
    steps: int
    actions: tuple[Action, ...] = ()


@dataclass(frozen=True)
class Scene:
    """One runnable problem with nothing left to resolve.

    `stages` is empty where nothing changes but driven particles. `contacts` says whether samples hold contact forces,
    `energies` whether they hold the ledger.
    `observables` are measures as the case states them, in SI (docs/case-keys.md).
    """

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
    drives: tuple[Drive, ...] = ()
    stages: tuple[Stage, ...] = ()
    contacts: bool = False
    energies: bool = True
    observables: tuple[dict[str, Any], ...] = ()

    @property
    def sample_steps(self) -> range:
        """The sampled steps."""
        return range(0, self.steps + 1, self.output_every)

    def stage_ends(self) -> list[int]:
        """Last step of every stage; that of the run where it has none."""
        return list(itertools.accumulate(stage.steps for stage in self.stages)) or [self.steps]

    def at_stage(self, index: int) -> Scene:
        """The scene with the pairs, motions and gravity that hold in a stage; all else is that of the start."""
        scene = self
        for stage in self.stages[: index + 1]:
            for action in stage.actions:
                scene = scene.after(action)
        return scene

    def after(self, action: Action) -> Scene:
        """The scene with what an action changes."""
        if isinstance(action, SetGravity):
            return replace(self, gravity=action.value)
        if isinstance(action, SetMotion):
            bodies = list(self.bodies)
            bodies[action.body] = replace(bodies[action.body], motion=action.motion)
            return replace(self, bodies=tuple(bodies))
        old = self.pair(*action.pair.between)
        return replace(self, pairs=tuple(action.pair if pair is old else pair for pair in self.pairs))

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
        if self.drives:
            raw["drives"] = [_drive_to_json(drive) for drive in self.drives]
        if self.stages:
            raw["stages"] = [
                {"name": stage.name, "steps": stage.steps, "actions": [_action_to_json(item) for item in stage.actions]}
                for stage in self.stages
            ]
        for optional in ("drives", "stages", "contacts", "observables"):
            if not raw[optional]:
                del raw[optional]
        if self.energies:
            del raw["energies"]
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


def _action_to_json(action: Action) -> dict[str, Any]:
    raw = asdict(action)
    if isinstance(action, SetPair):
        raw["pair"] = _pair_to_json(action.pair)
    elif isinstance(action, SetMotion):
        raw["motion"] = variant_to_json(raw["motion"])
    return raw


def _drive_to_json(drive: Drive) -> dict[str, Any]:
    raw = asdict(drive)
    for leg in raw["legs"]:
        leg["course"] = variant_to_json(leg["course"])
    return raw


def _drive(item: dict[str, Any]) -> Drive:
    vectors = ("position", "velocity", "angular_velocity", "rotation", "point")
    legs = [
        Leg(steps=leg["steps"], course=Course(**leg["course"]), **{name: _vector(leg[name]) for name in vectors})
        for leg in item["legs"]
    ]
    return Drive(item["particle"], tuple(legs))


def _vector(raw: list[float]) -> Vector:
    return (float(raw[0]), float(raw[1]), float(raw[2]))


def _shape(item: dict[str, Any]) -> Shape:
    if item["kind"] == "plane":
        return Plane(_vector(item["point"]), _vector(item["normal"]))
    if item["kind"] == "cylinder":
        return Cylinder(_vector(item["point"]), _vector(item["axis"]), float(item["radius"]))
    raise ValueError(f"shape {item['kind']!r} is unknown (known: plane, cylinder)")


def _motion(item: dict[str, Any]) -> Motion:
    velocity = item.get("velocity")
    return Motion(item["kind"], None if velocity is None else _vector(velocity))


def _body(item: dict[str, Any]) -> Body:
    shape, motion = _shape(item["shape"]), _motion(item["motion"])
    return Body(name=item["name"], material=item["material"], shape=shape, motion=motion)


def _action(item: dict[str, Any]) -> Action:
    if item["do"] == "set_pair":
        return SetPair(_pair(item["pair"]))
    if item["do"] == "set_motion":
        return SetMotion(item["body"], _motion(item["motion"]))
    if item["do"] == "set_gravity":
        return SetGravity(_vector(item["value"]))
    raise ValueError(f"action {item['do']!r} is unknown (known: set_pair, set_motion, set_gravity)")


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
        "drives": tuple(_drive(item) for item in raw.get("drives", [])),
        "stages": tuple(
            Stage(item["name"], item["steps"], tuple(_action(action) for action in item["actions"]))
            for item in raw.get("stages", [])
        ),
        "observables": tuple(raw.get("observables", [])),
    }
    return Scene(**{**raw, **typed})
