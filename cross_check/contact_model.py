"""The contact model of a scene: normal, tangential and moment law with their values (docs/formats.md)."""

from __future__ import annotations

from dataclasses import dataclass
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
}
_TANGENTIAL: dict[str, type[TangentialModel]] = {"mindlin": Mindlin, "linear_history": LinearHistory}


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
