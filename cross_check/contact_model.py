"""The contact model of a scene: normal, tangential and moment law with their values (docs/formats.md)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class NormalModel:
    """Normal law by name and whether its force is cut at zero: `on`, `off` or `default`.

    `hertz` and `dmt` have no other values; those of a pair stand with the pair.
    """

    law: str
    force_cut: str


@dataclass(frozen=True)
class LinearSpringDashpot(NormalModel):
    """`linear_spring_dashpot`: stiffness [N/m] and dashpot constant [kg/s] of every contact."""

    stiffness: float
    dashpot: float


@dataclass(frozen=True)
class AreaCohesion(NormalModel):
    """`sjkr` or `sjkr2`: Hertz with an attraction of `energy_density` [J/m3] times an area of the contact."""

    energy_density: float


@dataclass(frozen=True)
class LudingHysteretic(NormalModel):
    """`luding_hysteretic`: stiffnesses k1, kp, kc [N/m], plasticity depth phi_f [-], dashpot constant [kg/s]."""

    k1: float
    kp: float
    kc: float
    plasticity_depth: float
    dashpot: float


@dataclass(frozen=True, kw_only=True)
class LudingSintering(NormalModel):
    """`luding_sintering`: stiffnesses k1, k2, kc [N/m] when cold, fluid overlap [m], dashpot constant [kg/s].

    Melting temperature and the width of its range [K], relaxation time [s], and the `cooling` rule: `lagged` or
    `implicit`. Its force may pull: it has no cut, and states none.
    """

    k1: float
    k2: float
    kc: float
    fluid_overlap: float
    dashpot: float
    melting_temperature: float
    melting_range: float
    relaxation_time: float
    cooling: str
    force_cut: str = "off"


@dataclass(frozen=True)
class TangentialModel:
    """Tangential law by name; `frictionless` has no values."""

    law: str


@dataclass(frozen=True)
class Mindlin(TangentialModel):
    """`mindlin`: history `displacement`, `force`, `force_rescaled` or `default`, which leaves it to the code."""

    history: str


@dataclass(frozen=True)
class LinearHistory(TangentialModel):
    """`linear_history`: stiffness as a share of the normal stiffness [-] and dashpot constant [kg/s]."""

    stiffness_ratio: float
    dashpot: float


@dataclass(frozen=True)
class SinteringFriction(TangentialModel):
    """`luding_sintering`: stiffness as a share of the unloading stiffness [-] and dashpot constant [kg/s].

    `friction` `softens` with heat or is `constant`; a contact that slides pulls as before (`sliding` `off`), not at all
    (`cut`), or forgets what let it pull (`brittle`).
    """

    stiffness_ratio: float
    dashpot: float
    friction: str
    sliding: str


@dataclass(frozen=True)
class RollingStiffness:
    """`tangential` (kt R*^2), `constant` (value [N m]), `per_radius_squared` (value [N/m] R*^2), `normal`.

    `normal` is value kn mu_r^2 R*^2 with the secant normal stiffness kn and a factor `value` [-].
    """

    kind: str
    value: float | None = None


@dataclass(frozen=True)
class RollingDashpot:
    """`none`, `critical_share` (share `value` [-] of critical damping) or `per_radius_squared` (value [kg/s] R*^2)."""

    kind: str
    value: float | None = None


@dataclass(frozen=True)
class TwistingModel:
    """`none`; `joint` with the rolling spring; `spot` (kt a^2/2, cap 2/3 a mu_t F_n); `constant`.

    `constant` has a stiffness [N m], a dashpot constant [N m s] and an arm [m]: its cap is arm mu_t F_n, None no cap.
    """

    kind: str
    stiffness: float | None = None
    dashpot: float | None = None
    arm: float | None = None


@dataclass(frozen=True)
class MomentModel:
    """Moment law by name; `free` has no values."""

    law: str


@dataclass(frozen=True)
class ElasticPlasticRolling(MomentModel):
    """`elastic_plastic_rolling`: `limit` is `effective_radius` (mu_r F_n R*) or `unlimited`."""

    stiffness: RollingStiffness
    dashpot: RollingDashpot
    limit: str
    twisting: TwistingModel


@dataclass(frozen=True)
class ConstantTorque(MomentModel):
    """`constant_torque`: mu_r F_e R* against the rolling, with `torsion` against the whole relative spin."""

    torsion: bool


FRICTIONLESS = TangentialModel("frictionless")
FREE = MomentModel("free")


@dataclass(frozen=True)
class Model:
    """The composed contact model."""

    normal: NormalModel
    tangential: TangentialModel = FRICTIONLESS
    moments: MomentModel = FREE


_NORMAL: dict[str, type[NormalModel]] = {
    "linear_spring_dashpot": LinearSpringDashpot,
    "sjkr": AreaCohesion,
    "sjkr2": AreaCohesion,
    "luding_hysteretic": LudingHysteretic,
    "luding_sintering": LudingSintering,
}
_TANGENTIAL: dict[str, type[TangentialModel]] = {
    "mindlin": Mindlin,
    "linear_history": LinearHistory,
    "luding_sintering": SinteringFriction,
}


def _moments(raw: dict[str, Any]) -> MomentModel:
    if raw["law"] == "constant_torque":
        return ConstantTorque(**raw)
    if raw["law"] != "elastic_plastic_rolling":
        return MomentModel(**raw)
    return ElasticPlasticRolling(
        law=raw["law"],
        stiffness=RollingStiffness(**raw["stiffness"]),
        dashpot=RollingDashpot(**raw["dashpot"]),
        limit=raw["limit"],
        twisting=TwistingModel(**raw["twisting"]),
    )


def model_from_json(raw: dict[str, Any]) -> Model:
    """The typed view of a model; one without a tangential or moment law is frictionless or free."""
    normal, tangential = raw["normal"], raw.get("tangential", {"law": FRICTIONLESS.law})
    return Model(
        _NORMAL.get(normal["law"], NormalModel)(**normal),
        _TANGENTIAL.get(tangential["law"], TangentialModel)(**tangential),
        _moments(raw.get("moments", {"law": FREE.law})),
    )


def model_to_json(model: Model) -> dict[str, Any]:
    """The laws as the engine reads them; a frictionless or free one is not stated."""
    raw = asdict(model)
    if isinstance(model.normal, LudingSintering):
        del raw["normal"]["force_cut"]
    if model.tangential == FRICTIONLESS:
        del raw["tangential"]
    if model.moments == FREE:
        del raw["moments"]
    elif "stiffness" in raw["moments"]:
        parts = {name: variant_to_json(raw["moments"][name]) for name in ("stiffness", "dashpot", "twisting")}
        raw["moments"] |= parts
    return raw


def variant_to_json(raw: dict[str, Any]) -> dict[str, Any]:
    """A tagged variant without the values that it does not have; a constant twisting spring states its missing arm."""
    kept = {key: value for key, value in raw.items() if value is not None}
    return {**kept, "arm": raw["arm"]} if "arm" in raw and raw["kind"] == "constant" else kept
