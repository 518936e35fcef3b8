"""The contact laws of a scene in the words of LIGGGHTS: model, settings, global properties and their translation.

Hertz: F = 4/3 E* a d + 2 sqrt(5/6) b sqrt(Sn m*) v with b = -ln e / sqrt(ln^2 e + pi^2); E* and G* are formed by
LIGGGHTS from the moduli of both materials. `limitForce on` cuts the sum at zero, the default lets it pull.
`tangential history` keeps a displacement.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cross_check.adapters import capability, laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.liggghts import luding, moments
from cross_check.adapters.liggghts.properties import matrix, pair_rows
from cross_check.adapters.render import number, numbers
from cross_check.contact_model import AreaCohesion, LinearHistory, LinearSpringDashpot, LudingHysteretic
from cross_check.scene import Pair, Scene

NAME = "LIGGGHTS"
KNOWN = laws.Known(
    NAME,
    normal=("hertz", "linear_spring_dashpot", "sjkr", "sjkr2", "luding_hysteretic"),
    tangential=("frictionless", "mindlin", "linear_history"),
    moments=("free", "elastic_plastic_rolling", "constant_torque"),
)
# What LIGGGHTS accepts as coefficientRestitution.
RESTITUTION = (0.05, 1.0)
HISTORIES = ("displacement",)


@dataclass(frozen=True)
class Words:
    """A contact model in a deck: words after `model`, settings (last), comment, property commands, translation."""

    model: str
    settings: str
    comment: str
    properties: list[str]
    material_rows: list[Row]
    model_rows: list[Row]


def force_cut(scene: Scene) -> str:
    """`on` or `off`; LIGGGHTS does not cut when nothing is said, and never cuts a hysteretic law that is cohesive."""
    law = scene.model.normal
    if isinstance(law, LudingHysteretic) and law.kc > 0:
        return "off"
    return capability.resolved_cut(scene, default="off")


def restitution_of(damping_ratio: float) -> float:
    """CoefficientRestitution [-] whose dashpot is the fraction `damping_ratio` [-] of critical damping."""
    if damping_ratio >= 1.0:
        return 0.0
    return math.exp(-math.pi * damping_ratio / math.sqrt(1.0 - damping_ratio**2))


def words(scene: Scene) -> Words:
    """The contact model of `scene`. Raises NotComparable or InvalidScene with the reason."""
    laws.check(scene)
    pairs = capability.touching(scene)
    normal = _normal(scene, pairs)
    tangential = _tangential(scene, pairs)
    rolling = moments.words(scene, pairs)
    cohesion = f" cohesion {scene.model.normal.law}" if isinstance(scene.model.normal, AreaCohesion) else ""
    friction = "frictionless" if scene.model.tangential.law == "frictionless" else "friction"
    stated = scene.model.normal.force_cut
    cut = force_cut(scene)
    limit = Row("model.normal.force_cut", stated, "limitForce", cut, "-", "default: off, the force may pull")
    return Words(
        model=f"{normal.model}{tangential.model}{cohesion}{rolling.model}",
        settings=normal.settings + rolling.settings + (" limitForce on" if cut == "on" else ""),
        comment=f"{normal.comment}, {friction}{rolling.comment}",
        properties=normal.properties + tangential.properties + rolling.properties,
        material_rows=normal.material_rows + tangential.material_rows + rolling.pair_rows,
        model_rows=[*normal.model_rows, limit, *tangential.model_rows, *rolling.rows],
    )


def _restitution_row(scene: Scene, pair: Pair) -> Row:
    key = capability.pair_key(scene, pair)
    code_key = f"coefficientRestitution {pair.between[0] + 1} {pair.between[1] + 1}"
    value = restitution_of(pair.damping_ratio)
    asked = pair.restitution is not None and abs(pair.restitution - value) <= capability.SAME
    if asked and pair.restitution is not None:
        value = pair.restitution
    low, high = RESTITUTION
    if not low < value <= high:
        raise NotComparable(
            f"{key}: damping_ratio {number(pair.damping_ratio)} needs coefficientRestitution {number(value)}, "
            f"LIGGGHTS accepts {low} < e <= {high}"
        )
    if asked:
        return Row(key + ".restitution", number(value), code_key, number(value), "-", "as stated")
    formula = "exp(-pi b / sqrt(1 - b^2)), b = damping_ratio"
    return Row(key + ".damping_ratio", number(pair.damping_ratio), code_key, number(value), "-", formula)


def _material_rows(scene: Scene) -> list[Row]:
    rows: list[Row] = []
    for index, material in enumerate(scene.materials):
        young, poisson = (number(value) for value in capability.stiffness_of(scene, index))
        key, kind = f"materials.{material.name}", index + 1
        if material.rigid:
            rows.append(Row(f"{key}.rigid", "true", f"youngsModulus {kind}", young, "Pa", "rigid: 1/E = 0"))
            rows.append(Row(f"{key}.rigid", "true", f"poissonsRatio {kind}", poisson, "-", "rigid: has no effect"))
        else:
            rows.append(Row(f"{key}.young", young, f"youngsModulus {kind}", young, "Pa", "as stated"))
            rows.append(Row(f"{key}.poisson", poisson, f"poissonsRatio {kind}", poisson, "-", "as stated"))
    return rows


def _elastic(scene: Scene, pairs: list[Pair]) -> Words:
    """Hertz, alone or below an area-proportional cohesion."""
    law = scene.model.normal
    for pair in pairs:
        capability.check_effective_young(scene, pair, NAME)
    stiffness = [capability.stiffness_of(scene, index) for index in range(len(scene.materials))]
    restitution = {pair.between: _restitution_row(scene, pair) for pair in pairs}
    properties = [
        f"fix young all property/global youngsModulus peratomtype {numbers([young for young, _ in stiffness])}",
        f"fix poisson all property/global poissonsRatio peratomtype {numbers([poisson for _, poisson in stiffness])}",
        *matrix(
            scene,
            "restitution",
            "coefficientRestitution",
            {key: row.code_value for key, row in restitution.items()},
            never="1",
        ),
    ]
    material_rows = [*_material_rows(scene), *restitution.values()]
    comment = "no tangential model" if scene.model.tangential.law == "frictionless" else "Hertz"
    model_rows = [Row("model.normal.law", law.law, "pair_style gran", "model hertz", "-", comment)]
    if isinstance(law, AreaCohesion):
        density = number(law.energy_density)
        key = "cohesionEnergyDensity"
        properties += matrix(scene, "cohesion", key, {pair.between: density for pair in pairs}, never="0")
        model_rows.append(Row("model.normal.energy_density", density, key, density, "J/m3", f"cohesion {law.law}"))
    return Words("hertz", "", "Hertz and dashpot", properties, material_rows, model_rows)


def _normal(scene: Scene, pairs: list[Pair]) -> Words:
    law = scene.model.normal
    if isinstance(law, LudingHysteretic):
        properties, rows = luding.words(scene, pairs, law)
        return Words("luding", "", "k1, kp, kc with hysteresis", properties, [], rows)
    return _linear(scene, law) if isinstance(law, LinearSpringDashpot) else _elastic(scene, pairs)


def _linear(scene: Scene, law: LinearSpringDashpot) -> Words:
    """The same stiffness and dashpot for every pair."""
    properties: list[str] = []
    rows = [Row("model.normal.law", law.law, "pair_style gran", "model hooke/stiffness", "-", "kn and gamman typed")]
    for name, code_key, value, unit in (
        ("stiffness", "kn", law.stiffness, "N/m"),
        ("dashpot", "gamman_abs", law.dashpot, "kg/s"),
    ):
        text = number(value)
        properties += matrix(scene, name, code_key, {}, never=text)
        rows.append(Row(f"model.normal.{name}", text, code_key, text, unit, "as stated"))
    # hooke/stiffness asks for its tangential values even where no tangential model uses them.
    if scene.model.tangential.law == "frictionless":
        for name, code_key in (("shear_stiffness", "kt"), ("shear_dashpot", "gammat_abs")):
            properties += matrix(scene, name, code_key, {}, never="0")
    return Words("hooke/stiffness", " absolute_damping on", "linear spring and dashpot", properties, [], rows)


def _tangential(scene: Scene, pairs: list[Pair]) -> Words:
    """No words without friction; the Coulomb cap, and the linear spring where its values are typed."""
    law, normal = scene.model.tangential, scene.model.normal
    if law.law == "frictionless":
        return Words("", "", "", [], [], [])
    own = laws.history(scene, NAME, HISTORIES)
    values, rows = pair_rows(scene, pairs, "friction", "coefficientFriction", lambda pair: laws.friction(scene, pair))
    properties = matrix(scene, "friction", "coefficientFriction", values, never="0")
    model_rows = [Row("model.tangential.law", law.law, "tangential", "history", "-", f"keeps a {own}")]
    if isinstance(law, LinearHistory):
        stiffness = normal.stiffness if isinstance(normal, LinearSpringDashpot) else 0.0
        for fix, key, code_key, stated, value, unit, formula in (
            (
                "shear_stiffness",
                "stiffness_ratio",
                "kt",
                law.stiffness_ratio,
                law.stiffness_ratio * stiffness,
                "N/m",
                "ratio kn",
            ),
            ("shear_dashpot", "dashpot", "gammat_abs", law.dashpot, law.dashpot, "kg/s", "as stated"),
        ):
            properties += matrix(scene, fix, code_key, {}, never=number(value))
            model_rows.append(Row(f"model.tangential.{key}", number(stated), code_key, number(value), unit, formula))
        if not isinstance(normal, LinearSpringDashpot):
            raise NotComparable(f"LIGGGHTS has linear_history beside linear_spring_dashpot only, not {normal.law}")
    else:
        for pair in pairs:
            laws.check_effective_shear(scene, pair, NAME)
    return Words(" tangential history", "", "", properties, rows, model_rows)
