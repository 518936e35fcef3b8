"""Options of the native engine that reproduce another code (docs/formats.md, the types of `src/laws`)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from cross_check.contact_model import RollingDashpot, RollingStiffness, variant_to_json


@dataclass(frozen=True)
class Arms:
    """Lever arms of a kind of contact: `mid_overlap` (R - d/2), `radius` (R) or `surface` (R - d)."""

    slip: str
    torque: str


@dataclass(frozen=True)
class TangentialOptions:
    """How a code treats its tangential spring.

    `history`: displacement | force | force_rescaled. `rotation`: rigid | projection | projection_rescaled |
    small_angles | fixed. `order`: rotate_first | increment_first. `increment`: present | mean. `cap`: total |
    total_when_stretched | elastic.
    `friction`: total | without_adhesion | pull_off_added | twice_pull_off.
    """

    history: str
    rotation: str
    order: str
    increment: str
    cap: str
    friction: str
    pair_arms: Arms
    wall_arms: Arms


@dataclass(frozen=True)
class RollingOptions:
    """How a code treats its rolling spring; `limit`: effective_radius | mean_radius | while_pressed | unlimited.

    `setup_step` [s] is the time over which the spring grows, and then forgets it, where forces are evaluated before the
    first step.
    """

    stiffness: RollingStiffness
    limit: str
    dashpot: RollingDashpot
    history: str
    rotation: str
    cap: str
    torsion: bool
    stretched_at_walls: bool
    setup_step: float = 0.0


@dataclass(frozen=True)
class TwistingSpring:
    """`spot`, or `constant` with stiffness [N m], dashpot constant [N m s] and arm [m], None for no cap."""

    kind: str
    stiffness: float | None = None
    dashpot: float | None = None
    arm: float | None = None


@dataclass(frozen=True)
class TwistingOptions:
    """How a code treats its twisting spring; `cap`: total | elastic | total_along_rate."""

    spring: TwistingSpring
    history: str
    rotation: str
    cap: str


@dataclass(frozen=True)
class Mirror:
    """Engine options that reproduce another code; the plain engine has a plane without curvature, `synchronized`.

    `code` names it: the engine refuses options that it does not have. `cylinder_curvature` is the share of its
    curvature that a cylinder has in R*, None for all of it. The others are None where the model has no such law or the
    plain choice stands: `opposed` of the constant torque (rolling | rolling_share | whole_spin),
    `dashpot_limit` of an adhesive law (base | pull_off), `hysteresis` rule of luding_hysteretic (self_consistent |
    old_stiffness | luding_pm).
    """

    plane_radius_factor: float | None
    start: str
    code: str | None = None
    cylinder_curvature: float | None = None
    tangential: TangentialOptions | None = None
    rolling: RollingOptions | None = None
    twisting: TwistingOptions | None = None
    opposed: str | None = None
    dashpot_limit: str | None = None
    hysteresis: str | None = None


# Options that a scene always states; the others stand only where they are set.
ALWAYS = ("plane_radius_factor", "start")


def mirror_to_json(mirror: Mirror) -> dict[str, Any]:
    """The options as the engine reads them: variants carry only the values that they have."""
    raw = {key: value for key, value in asdict(mirror).items() if key in ALWAYS or value is not None}
    for name, part in (("rolling", "stiffness"), ("rolling", "dashpot"), ("twisting", "spring")):
        if name in raw:
            raw[name][part] = variant_to_json(raw[name][part])
    if "rolling" in raw and raw["rolling"]["stiffness"]["kind"] == "normal":
        raw["rolling"]["stiffness"]["factor"] = raw["rolling"]["stiffness"].pop("value")
    return raw


def mirror_from_json(raw: dict[str, Any]) -> Mirror:
    """The typed view of the options."""
    typed = dict(raw)
    if "tangential" in raw:
        item = raw["tangential"]
        arms: dict[str, Any] = {name: Arms(**item[name]) for name in ("pair_arms", "wall_arms")}
        typed["tangential"] = TangentialOptions(**{**item, **arms})
    if "rolling" in raw:
        item = raw["rolling"]
        stiffness = dict(item["stiffness"])
        if "factor" in stiffness:
            stiffness["value"] = stiffness.pop("factor")
        parts: dict[str, Any] = {
            "stiffness": RollingStiffness(**stiffness),
            "dashpot": RollingDashpot(**item["dashpot"]),
        }
        typed["rolling"] = RollingOptions(**{**item, **parts})
    if "twisting" in raw:
        item = raw["twisting"]
        spring: dict[str, Any] = {"spring": TwistingSpring(**item["spring"])}
        typed["twisting"] = TwistingOptions(**{**item, **spring})
    return Mirror(**typed)
