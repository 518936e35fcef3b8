"""Scenes as the harness sees them: typed views of the JSON that the engine writes (docs/formats.md)."""

from __future__ import annotations

import hashlib
import itertools
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from cross_check.bodies import Body, Cylinder, Motion, Plane, Shape, body_from_json, body_to_json
from cross_check.contact_model import Model, NormalModel, model_from_json, model_to_json, variant_to_json
from cross_check.materials import Material, Pair, material_from_json, material_to_json, pair_from_json, pair_to_json
from cross_check.mirror_options import Mirror, mirror_from_json, mirror_to_json
from cross_check.stages import Action, SetGravity, SetMotion, SetPair, Stage, Strain, stage_from_json, stage_to_json
from cross_check.vector import Vector, vector

__all__ = [
    "Action",
    "Body",
    "Course",
    "Cylinder",
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
    "Plane",
    "Scene",
    "SetGravity",
    "SetMotion",
    "SetPair",
    "Shape",
    "Stage",
    "Start",
    "Vector",
    "from_json",
]


@dataclass(frozen=True)
class Domain:
    """Box that holds every particle: corners [m] and `open` or `periodic` per axis."""

    min: Vector
    max: Vector
    boundary: tuple[str, str, str]


@dataclass(frozen=True)
class Particle:
    """A sphere, or a disk where the scene has such, at t = 0: SI units, velocities synchronized with positions."""

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
class Start:
    """The state of another scene after `step` steps, from which a scene starts."""

    scene: Scene
    step: int


@dataclass(frozen=True)
class Scene:
    """One runnable problem with nothing left to resolve.

    `stages` is empty where nothing changes but driven particles. `contacts` says whether samples hold contact forces,
    `contact_states` whether also what contacts remember, `energies` whether they hold the ledger.
    `observables` are measures as the case states them, in SI (docs/case-keys.md). `disk_height` [m] is None for
    spheres, `temperature` [K], at which the radii stand, where the case states none. `start` is the state of another
    scene in which particles and walls begin; the particles here are then those of its own start.
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
    contact_states: bool = False
    energies: bool = True
    observables: tuple[dict[str, Any], ...] = ()
    disk_height: float | None = None
    temperature: float | None = None
    start: Start | None = None

    @property
    def sample_steps(self) -> Sequence[int]:
        """The sampled steps: the first, and in every stage multiples of its interval from its beginning on."""
        if not any(stage.output_every for stage in self.stages):
            return range(0, self.steps + 1, self.output_every)
        found, begin = [0], 0
        for stage in self.stages:
            every = stage.output_every or self.output_every
            found += range(begin + every, begin + stage.steps + 1, every)
            begin += stage.steps
        return found

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

    def motions(self) -> list[tuple[str, str]]:
        """Bodies by name and the kinds of their motions, at the start and in every stage: `strain` is one, too."""
        found = [(body.name, body.motion.kind) for body in self.bodies]
        for action in (action for stage in self.stages for action in stage.actions):
            if isinstance(action, SetMotion):
                found.append((self.bodies[action.body].name, action.motion.kind))
            elif isinstance(action, Strain):
                found.append((self.bodies[action.body].name, action.do))
        return found

    def after(self, action: Action) -> Scene:
        """The scene with what an action changes of it: others change the state of the run."""
        if isinstance(action, SetGravity):
            return replace(self, gravity=action.value)
        if isinstance(action, SetMotion):
            bodies = list(self.bodies)
            bodies[action.body] = replace(bodies[action.body], motion=action.motion)
            return replace(self, bodies=tuple(bodies))
        if isinstance(action, SetPair):
            old = self.pair(*action.pair.between)
            return replace(self, pairs=tuple(action.pair if pair is old else pair for pair in self.pairs))
        return self

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

    def to_dict(self) -> dict[str, Any]:
        """The scene as the engine reads and writes it."""
        plain = ("schema", "case", "variant", "seed", "refinement", "level", "time_step", "steps", "output_every")
        raw: dict[str, Any] = {name: getattr(self, name) for name in plain}
        raw |= {
            "gravity": self.gravity,
            "domain": asdict(self.domain),
            "materials": [material_to_json(material) for material in self.materials],
            "pairs": [pair_to_json(pair) for pair in self.pairs],
            "model": model_to_json(self.model),
            "mirror": mirror_to_json(self.mirror),
            "bodies": [body_to_json(body) for body in self.bodies],
            "particles": [asdict(particle) for particle in self.particles],
        }
        optional: dict[str, Any] = {
            "drives": [_drive_to_json(drive) for drive in self.drives],
            "stages": [stage_to_json(stage) for stage in self.stages],
            "contacts": self.contacts,
            "contact_states": self.contact_states,
            "observables": self.observables,
        }
        raw |= {name: value for name, value in optional.items() if value}
        if not self.energies:
            raw["energies"] = False
        for name in ("disk_height", "temperature"):
            if getattr(self, name) is not None:
                raw[name] = getattr(self, name)
        if self.start is not None:
            raw["start"] = {"scene": self.start.scene.to_dict(), "step": self.start.step}
        return raw

    def to_json(self) -> str:
        """The scene as text; the same scene has the same bytes."""
        return json.dumps(self.to_dict(), sort_keys=True)

    def digest(self) -> str:
        """Hash of the whole scene, hexadecimal."""
        return hashlib.blake2b(self.to_json().encode(), digest_size=16).hexdigest()


def _drive_to_json(drive: Drive) -> dict[str, Any]:
    raw = asdict(drive)
    for leg in raw["legs"]:
        leg["course"] = variant_to_json(leg["course"])
    return raw


def _drive(item: dict[str, Any]) -> Drive:
    vectors = ("position", "velocity", "angular_velocity", "rotation", "point")
    legs = [
        Leg(steps=leg["steps"], course=Course(**leg["course"]), **{name: vector(leg[name]) for name in vectors})
        for leg in item["legs"]
    ]
    return Drive(item["particle"], tuple(legs))


def _particle(item: dict[str, Any]) -> Particle:
    return Particle(
        material=item["material"],
        radius=item["radius"],
        mass=item["mass"],
        moment_of_inertia=item["moment_of_inertia"],
        position=vector(item["position"]),
        velocity=vector(item["velocity"]),
        angular_velocity=vector(item["angular_velocity"]),
    )


def from_json(raw: dict[str, Any]) -> Scene:
    """The typed view of one scene object. Raises ValueError for a shape, motion, load or action that is not known."""
    x, y, z = raw["domain"]["boundary"]
    typed: dict[str, Any] = {
        "gravity": vector(raw["gravity"]),
        "domain": Domain(vector(raw["domain"]["min"]), vector(raw["domain"]["max"]), (x, y, z)),
        "materials": tuple(material_from_json(item) for item in raw["materials"]),
        "pairs": tuple(pair_from_json(item) for item in raw["pairs"]),
        "model": model_from_json(raw["model"]),
        "mirror": mirror_from_json(raw["mirror"]),
        "bodies": tuple(body_from_json(item) for item in raw["bodies"]),
        "particles": tuple(_particle(item) for item in raw["particles"]),
        "drives": tuple(_drive(item) for item in raw.get("drives", [])),
        "stages": tuple(stage_from_json(item) for item in raw.get("stages", [])),
        "observables": tuple(raw.get("observables", [])),
    }
    if "start" in raw:
        typed["start"] = Start(from_json(raw["start"]["scene"]), raw["start"]["step"])
    return Scene(**{**raw, **typed})
