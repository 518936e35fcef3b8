"""What the translations ask of the contact laws of a scene: which ones a code has, and the values that a law needs."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, replace

from cross_check.adapters.capability import SAME, native_only, pair_key, stiffness_of
from cross_check.adapters.interface import InvalidScene, NotComparable
from cross_check.adapters.render import number
from cross_check.contact_model import (
    ElasticPlasticRolling,
    LinearSpringDashpot,
    LudingHysteretic,
    Mindlin,
    NormalModel,
    TangentialModel,
)
from cross_check.scene import Pair, Particle, Scene, Vector

ORIGIN: Vector = (0.0, 0.0, 0.0)
FORCE_CUTS = ("on", "off", "default")
HISTORIES = ("displacement", "force", "force_rescaled")


@dataclass(frozen=True)
class Known:
    """The laws that a code has a form for."""

    code: str
    normal: tuple[str, ...]
    tangential: tuple[str, ...]
    moments: tuple[str, ...]


def comparable(scene: Scene, known: Known) -> None:
    """Raises NotComparable with all that the code lacks: what only the native engine computes, and laws.

    Decks and mirrors ask this first: a scene that no code has a form for need not be valid for one.
    """
    model = scene.model
    kinds = (
        ("normal", model.normal.law, known.normal),
        ("tangential", model.tangential.law, known.tangential),
        ("moment", model.moments.law, known.moments),
    )
    reasons = [
        f"the {kind} law {law} has no translation in {known.code} (known: {', '.join(laws)})"
        for kind, law, laws in kinds
        if law not in laws
    ]
    reasons += native_only(scene)
    if reasons:
        raise NotComparable("; ".join(reasons))


def check(scene: Scene) -> None:
    """Raises InvalidScene for values that no law allows, NotComparable for laws that do not stand together."""
    model = scene.model
    if model.normal.force_cut not in FORCE_CUTS:
        raise InvalidScene(f"force_cut {model.normal.force_cut!r} is unknown (known: {', '.join(FORCE_CUTS)})")
    _check_normal(model.normal)
    _check_tangential(model.tangential, model.normal)


def _check_normal(law: NormalModel) -> None:
    if isinstance(law, LinearSpringDashpot) and not (law.stiffness > 0 and law.dashpot >= 0):
        raise InvalidScene("model.normal: stiffness > 0 and dashpot >= 0 are allowed")
    if isinstance(law, LudingHysteretic) and not (
        0 < law.k1 < law.kp and law.kc >= 0 and law.plasticity_depth > 0 and law.dashpot >= 0
    ):
        raise InvalidScene("model.normal: 0 < k1 < kp, kc >= 0, plasticity_depth > 0 and dashpot >= 0 are allowed")


def _check_tangential(law: TangentialModel, normal: NormalModel) -> None:
    if isinstance(law, Mindlin) and law.history not in (*HISTORIES, "default"):
        raise InvalidScene(f"history {law.history!r} is unknown (known: {', '.join(HISTORIES)}, default)")
    elastic = normal.law in ("hertz", "dmt", "sjkr", "sjkr2")
    if law.law == "mindlin" and not elastic:
        raise NotComparable(f"mindlin needs the contact radius of Hertz, {normal.law} has none")
    if law.law == "linear_history" and elastic:
        raise NotComparable(f"linear_history needs a constant normal stiffness, {normal.law} has none")


def elastic(scene: Scene) -> bool:
    """Whether the normal law is Hertz or built on it, with moduli and a fraction of critical damping per pair."""
    return scene.model.normal.law in ("hertz", "dmt", "sjkr", "sjkr2")


def damped(scene: Scene, pairs: list[Pair]) -> bool:
    """Whether any of the contacts has a normal dashpot."""
    law = scene.model.normal
    if isinstance(law, LinearSpringDashpot | LudingHysteretic):
        return law.dashpot > 0
    return any(pair.damping_ratio > 0 for pair in pairs)


def frictional(scene: Scene) -> bool:
    """Whether the model has a tangential force."""
    return scene.model.tangential.law != "frictionless"


def history(scene: Scene, code: str, own: tuple[str, ...]) -> str:
    """What the Mindlin spring remembers: as stated, or the first of the code's `own` where it is left to the code."""
    law = scene.model.tangential
    if not isinstance(law, Mindlin) or law.history == "default":
        return own[0]
    if law.history not in own:
        raise NotComparable(f"the history {law.history} has no translation in {code} (known: {', '.join(own)})")
    return law.history


def coefficient(scene: Scene, pair: Pair, name: str, value: float | None) -> float:
    """A value of a pair that a law needs; InvalidScene where it is missing or negative."""
    if value is None or value < 0:
        raise InvalidScene(f"{pair_key(scene, pair)}.{name} = {value!r}: the laws of the model need it, not negative")
    return value


def friction(scene: Scene, pair: Pair) -> float:
    """Coefficient of friction [-]."""
    return coefficient(scene, pair, "friction", pair.friction)


def rolling_friction(scene: Scene, pair: Pair) -> float:
    """Coefficient of rolling friction [-]."""
    return coefficient(scene, pair, "rolling_friction", pair.rolling_friction)


def effective_shear(scene: Scene, pair: Pair) -> float:
    """G* [Pa] of a pair whose law needs it."""
    if pair.effective_shear is None or not pair.effective_shear > 0:
        raise InvalidScene(f"{pair_key(scene, pair)}.effective_shear = {pair.effective_shear!r}: mindlin needs it, > 0")
    return pair.effective_shear


def check_effective_shear(scene: Scene, pair: Pair, code: str) -> None:
    """Raises NotComparable where a code that forms G* from its materials would not get the G* of the scene."""
    compliance = 0.0
    for index in pair.between:
        young, poisson = stiffness_of(scene, index)
        compliance += 2.0 * (2.0 - poisson) * (1.0 + poisson) / young
    if abs(effective_shear(scene, pair) * compliance - 1.0) > SAME:
        raise NotComparable(
            f"{code} forms G* = {number(1.0 / compliance)} Pa from the two materials of {pair_key(scene, pair)}, "
            f"the scene states {number(effective_shear(scene, pair))} Pa"
        )


def rolling(scene: Scene) -> ElasticPlasticRolling | None:
    """The rolling spring of the model, if it has one."""
    law = scene.model.moments
    return law if isinstance(law, ElasticPlasticRolling) else None


def _sides(scene: Scene, pair: Pair) -> tuple[set[tuple[Particle, Particle]], set[Particle]]:
    """Kinds of particles, by radius and mass, that a pair of materials brings together, and those it has at bodies."""
    i, j = pair.between
    kinds = {index: Counter[Particle]() for index in (i, j)}
    for particle in scene.particles:
        if particle.material in kinds:
            kinds[particle.material][replace(particle, position=ORIGIN, velocity=ORIGIN, angular_velocity=ORIGIN)] += 1
    together = {(a, b) for a in kinds[i] for b in kinds[j] if i != j or a != b or kinds[i][a] > 1}
    walls = {body.material for body in scene.bodies}
    alone = {kind for own, other in ((i, j), (j, i)) if other in walls for kind in kinds[own]}
    return together, alone


def radii(scene: Scene, pair: Pair, plane_factor: float) -> set[tuple[float, float]]:
    """Radii [m] of both sides of every contact that a pair can have; a plane is `plane_factor` times its sphere."""
    together, alone = _sides(scene, pair)
    found = {(max(a.radius, b.radius), min(a.radius, b.radius)) for a, b in together}
    return found | {(kind.radius * plane_factor, kind.radius) for kind in alone}


def reduced_masses(scene: Scene, pair: Pair) -> set[float]:
    """Reduced mass [kg] of every contact that a pair can have; a particle's own mass at a body."""
    together, alone = _sides(scene, pair)
    return {a.mass * b.mass / (a.mass + b.mass) for a, b in together} | {kind.mass for kind in alone}


def effective_radius(both: tuple[float, float]) -> float:
    """R* [m]; that of a sphere itself where the other side is infinite."""
    large, small = both
    return small if math.isinf(large) else large * small / (large + small)


def one_value(values: set[float], what: str) -> float:
    """The value that all contacts share, up to rounding; NotComparable where they do not."""
    if not values or max(values) - min(values) > SAME * abs(max(values)):
        listed = ", ".join(number(value) for value in sorted(values))
        raise NotComparable(f"{what} must be the same for all contacts, here it would be {listed or 'none'}")
    return max(values)
