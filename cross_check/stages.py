"""Stages of a scene: what changes at their beginnings (docs/formats.md)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from cross_check.bodies import Motion, motion_from_json, motion_to_json
from cross_check.materials import Pair, pair_from_json, pair_to_json
from cross_check.vector import Vector, vector


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


@dataclass(frozen=True)
class Remove:
    """Takes a body, by index, away."""

    body: int
    do: str = "remove"


@dataclass(frozen=True)
class Strain:
    """Moves a body, by index, towards another one over the stage, by a share `strain` [-] of their distance."""

    body: int
    # The key `from`, which is no name in Python.
    towards: int
    strain: float
    do: str = "strain"


@dataclass(frozen=True)
class RampTemperature:
    """Brings the temperature of the particles linearly over the stage `to` a value [K]."""

    to: float
    do: str = "ramp_temperature"


@dataclass(frozen=True)
class SetRelaxationTime:
    """Changes the relaxation time [s] of the contact law."""

    value: float
    do: str = "set_relaxation_time"


Action = SetPair | SetMotion | SetGravity | Remove | Strain | RampTemperature | SetRelaxationTime
ACTIONS = ("set_pair", "set_motion", "set_gravity", "remove", "strain", "ramp_temperature", "set_relaxation_time")


@dataclass(frozen=True)
class Stage:
    """A part of the run: its name, number of steps, and what changes at its beginning.

    Actions take effect after the sample of the step at which the stage begins, before the next step. `output_every` is
    the number of steps between its samples, None for that of the scene.
    """

    name: str
    steps: int
    actions: tuple[Action, ...] = ()
    output_every: int | None = None


def stage_from_json(raw: dict[str, Any]) -> Stage:
    """The typed view of a stage. Raises ValueError for an unknown action."""
    actions = tuple(action_from_json(action) for action in raw["actions"])
    return Stage(raw["name"], raw["steps"], actions, raw.get("output_every"))


def stage_to_json(stage: Stage) -> dict[str, Any]:
    """A stage as the engine reads it."""
    actions = [action_to_json(action) for action in stage.actions]
    raw: dict[str, Any] = {"name": stage.name, "steps": stage.steps, "actions": actions}
    return raw if stage.output_every is None else {**raw, "output_every": stage.output_every}


def action_from_json(raw: dict[str, Any]) -> Action:
    """The typed view of an action. Raises ValueError for an unknown one."""
    match raw["do"]:
        case "set_pair":
            return SetPair(pair_from_json(raw["pair"]))
        case "set_motion":
            return SetMotion(raw["body"], motion_from_json(raw["motion"]))
        case "set_gravity":
            return SetGravity(vector(raw["value"]))
        case "remove":
            return Remove(raw["body"])
        case "strain":
            return Strain(raw["body"], raw["from"], raw["strain"])
        case "ramp_temperature":
            return RampTemperature(raw["to"])
        case "set_relaxation_time":
            return SetRelaxationTime(raw["value"])
        case unknown:
            raise ValueError(f"action {unknown!r} is unknown (known: {', '.join(ACTIONS)})")


def action_to_json(action: Action) -> dict[str, Any]:
    """An action as the engine reads it."""
    raw = asdict(action)
    if isinstance(action, SetPair):
        raw["pair"] = pair_to_json(action.pair)
    elif isinstance(action, SetMotion):
        raw["motion"] = motion_to_json(action.motion)
    elif isinstance(action, Strain):
        raw["from"] = raw.pop("towards")
    return raw
