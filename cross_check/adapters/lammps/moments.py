"""Rolling and twisting resistance in the words of LAMMPS: `rolling sds`, `twisting sds`, `twisting marshall`."""

from __future__ import annotations

import math

from cross_check.adapters import capability, laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.render import number
from cross_check.contact_model import ElasticPlasticRolling
from cross_check.scene import Pair, Scene


def stiffness(scene: Scene, law: ElasticPlasticRolling, pair: Pair) -> float:
    """Stiffness of the rolling displacement [N/m] of a pair."""
    value = law.stiffness.value or 0.0
    if law.stiffness.kind == "per_radius_squared":
        return value
    if law.stiffness.kind != "constant":
        raise NotComparable(f"LAMMPS's rolling stiffness does not follow the overlap, {law.stiffness.kind} does")
    found = {value / laws.effective_radius(both) ** 2 for both in laws.radii(scene, pair, math.inf)}
    return laws.one_value(found, f"LAMMPS: {capability.pair_key(scene, pair)}, rolling stiffness / R*^2")


def _dashpot(law: ElasticPlasticRolling) -> float:
    if law.dashpot.kind not in ("none", "per_radius_squared"):
        raise NotComparable(f"the rolling dashpot {law.dashpot.kind} has no translation in LAMMPS (per_radius_squared)")
    return law.dashpot.value or 0.0


def _twisting(scene: Scene, law: ElasticPlasticRolling, pair: Pair) -> str:
    kind = law.twisting.kind
    if kind == "none":
        return ""
    if kind == "joint":
        raise NotComparable("LAMMPS has a spring of its own for twisting, the scene joins it to rolling")
    friction = laws.coefficient(scene, pair, "twisting_friction", pair.twisting_friction)
    if kind == "spot":
        if scene.model.tangential.law != "mindlin":
            raise NotComparable("LAMMPS's marshall needs the contact radius of mindlin, which the scene does not have")
        if friction != laws.friction(scene, pair):
            raise NotComparable(
                "LAMMPS's marshall twists with the coefficient of sliding friction, the scene has another"
            )
        return " twisting marshall"
    if law.twisting.arm is None:
        raise NotComparable("LAMMPS always caps twisting, the scene does not")
    values = (law.twisting.stiffness or 0.0, law.twisting.dashpot or 0.0, law.twisting.arm * friction)
    return " twisting sds " + " ".join(number(value) for value in values)


def words(scene: Scene, pair: Pair) -> str:
    """The words of the moment law, none if particles turn freely. Raises NotComparable with the reason."""
    law = scene.model.moments
    if not isinstance(law, ElasticPlasticRolling):
        return ""
    if law.limit != "effective_radius":
        raise NotComparable(f"LAMMPS caps rolling torques with R*, the scene asks for the limit {law.limit}")
    values = (stiffness(scene, law, pair), _dashpot(law), laws.rolling_friction(scene, pair))
    return " rolling sds " + " ".join(number(value) for value in values) + _twisting(scene, law, pair)


def no_contact(scene: Scene) -> str:
    """The same law without stiffness, for atom types that never touch."""
    law = scene.model.moments
    if not isinstance(law, ElasticPlasticRolling):
        return ""
    twisting = {"spot": " twisting marshall", "constant": " twisting sds 0 0 0"}.get(law.twisting.kind, "")
    return f" rolling sds 0 0 0{twisting}"


def rows(scene: Scene, pair: Pair) -> list[Row]:
    """The translation of the moment law."""
    law = scene.model.moments
    if not isinstance(law, ElasticPlasticRolling):
        return []
    key, typed = capability.pair_key(scene, pair), words(scene, pair).split()
    formula = "as stated" if law.stiffness.kind == "per_radius_squared" else "stiffness / R*^2"
    stated, dashpot = number(law.stiffness.value or 0.0), number(law.dashpot.value or 0.0)
    found = [
        Row("model.moments.stiffness.value", stated, f"{key} rolling sds K", typed[2], "N/m", formula),
        Row("model.moments.dashpot.value", dashpot, f"{key} rolling sds GAMMA", typed[3], "kg/s", "as stated"),
        Row(f"{key}.rolling_friction", typed[4], "rolling sds MU", typed[4], "-", "as stated"),
    ]
    twisting = law.twisting
    if twisting.kind == "spot":
        found.append(Row("model.moments.twisting", "spot", "twisting", "marshall", "-", "kt a^2/2, 2/3 a mu"))
    elif twisting.kind == "constant":
        friction = number(pair.twisting_friction or 0.0)
        for name, value, letter, at, unit in (
            ("stiffness", twisting.stiffness, "K", 7, "N m"),
            ("dashpot", twisting.dashpot, "GAMMA", 8, "N m s"),
        ):
            text = number(value or 0.0)
            code_key = f"{key} twisting sds {letter}"
            found.append(Row(f"model.moments.twisting.{name}", text, code_key, typed[at], unit, "as stated"))
        found.append(Row(f"{key}.twisting_friction", friction, "twisting sds MU", typed[9], "m", "arm mu_t"))
    return found
