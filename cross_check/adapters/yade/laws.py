"""The contact laws of a scene in the words of YADE: materials, interaction physics, law functor and translation.

Hertz: F = 4/3 E* a d + 2 betan sqrt(Sn m*) v, cut at zero always; E* and G* are formed by YADE from both materials. The
tangential spring of MindlinPhys keeps a force. ViscElMat gives each pair k1 k2 / (k1 + k2): twice the constants of the
scene are typed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from cross_check.adapters import capability, laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.render import number, word
from cross_check.adapters.yade import moments
from cross_check.contact_model import LinearHistory, LinearSpringDashpot, LudingHysteretic
from cross_check.scene import Pair, Scene

NAME = "YADE"
KNOWN = laws.Known(
    NAME,
    normal=("hertz", "linear_spring_dashpot", "dmt", "luding_hysteretic"),
    tangential=("frictionless", "mindlin", "linear_history"),
    moments=("free", "elastic_plastic_rolling"),
)
HISTORIES = ("force",)


@dataclass(frozen=True)
class Words:
    """A contact model in a deck: classes, constructors, matchers, words of functors, comments and rows."""

    material: str
    physics: str
    law: str
    constructors: list[str]
    matchers: list[str]
    physics_words: str
    law_words: str
    comment: str
    material_rows: list[Row]
    model_rows: list[Row]
    materials_comment: str = "frictionless"


def force_cut(scene: Scene) -> str:
    """`on`: YADE always cuts. Raises NotComparable where the scene wants a dashpot that may pull."""
    stated, law = scene.model.normal.force_cut, scene.model.normal.law
    loose = laws.damped(scene, capability.touching(scene))
    if law == "dmt":
        if stated != "default" and loose:
            raise NotComparable(
                f"YADE limits the dashpot of DMT to the pull-off force, the scene asks for a cut {stated}"
            )
        return "off"
    if law == "luding_hysteretic":
        if stated == "on" and loose:
            raise NotComparable("YADE never cuts the dashpot of LudingPM, the scene cuts it")
        return "off"
    if stated == "off" and loose:
        raise NotComparable("YADE always cuts the total normal force at zero, the scene lets the dashpot pull")
    return "on"


def betan_of(damping_ratio: float) -> float:
    """Return betan [-] of the dashpot 2 sqrt(5/6) b sqrt(Sn m*)."""
    return math.sqrt(5.0 / 6.0) * damping_ratio


def words(scene: Scene) -> Words:
    """The contact model of `scene`. Raises NotComparable or InvalidScene with the reason."""
    laws.check(scene)
    pairs = capability.touching(scene)
    law = scene.model.normal
    if isinstance(law, LudingHysteretic):
        return _luding(scene, law)
    if isinstance(law, LinearSpringDashpot):
        return _linear(scene, pairs, law)
    return _mindlin(scene, pairs)


def _material_rows(scene: Scene) -> list[Row]:
    rows: list[Row] = []
    for index, material in enumerate(scene.materials):
        young, poisson = (number(value) for value in capability.stiffness_of(scene, index))
        key, code_key = f"materials.{material.name}", f"FrictMat {index}"
        if material.rigid:
            rows.append(Row(f"{key}.rigid", "true", f"{code_key} young", young, "Pa", "rigid: 1/E = 0"))
            rows.append(Row(f"{key}.rigid", "true", f"{code_key} poisson", poisson, "-", "rigid: has no effect"))
        else:
            rows.append(Row(f"{key}.young", young, f"{code_key} young", young, "Pa", "as stated"))
            rows.append(Row(f"{key}.poisson", poisson, f"{code_key} poisson", poisson, "-", "as stated"))
    return rows


def _constructors(scene: Scene, name: str, values: Callable[[int], str]) -> list[str]:
    return [
        f'{name}({values(index)}, label="{index} {word(material.name)}")'
        for index, material in enumerate(scene.materials)
    ]


def _matches(name: str, values: dict[tuple[int, int], str]) -> str:
    entries = "".join(f"({i}, {j}, {value}), " for (i, j), value in values.items())
    return f'{name} = MatchMaker(matches=({entries}), algo="val", val=0)'


def _pair_row(scene: Scene, pair: Pair, code_key: str) -> Row:
    key = f"{capability.pair_key(scene, pair)}.damping_ratio"
    betan = number(betan_of(pair.damping_ratio))
    return Row(
        key, number(pair.damping_ratio), f"{code_key} {pair.between[0]} {pair.between[1]}", betan, "-", "sqrt(5/6) b"
    )


def _angles(scene: Scene, pairs: list[Pair]) -> tuple[dict[tuple[int, int], str], list[Row]]:
    """Friction angle [rad] of every pair and its rows."""
    angles: dict[tuple[int, int], str] = {}
    rows: list[Row] = []
    for pair in pairs:
        friction = laws.friction(scene, pair)
        angle = angles[pair.between] = number(math.atan(friction))
        i, j = pair.between
        key = f"{capability.pair_key(scene, pair)}.friction"
        rows.append(Row(key, number(friction), f"frictAngle {i} {j}", angle, "rad", "atan(mu)"))
    return angles, rows


def _mindlin(scene: Scene, pairs: list[Pair]) -> Words:
    """MindlinPhys: Hertz or DMT, with or without friction."""
    normal, sliding = scene.model.normal, laws.frictional(scene)
    for pair in pairs:
        capability.check_effective_young(scene, pair, NAME)
    stiffness = [capability.stiffness_of(scene, index) for index in range(len(scene.materials))]
    betan = {pair.between: number(betan_of(pair.damping_ratio)) for pair in pairs}
    matchers = [_matches("betan", betan)]
    material_rows = [*_material_rows(scene), *(_pair_row(scene, pair, "betan") for pair in pairs)]
    physics = "betan=betan, betas=betas"
    law_words: list[str] = []
    note = "no friction, betas = 0"
    if sliding:
        note = f"keeps a {laws.history(scene, NAME, HISTORIES)}, betas = betan"
        for pair in pairs:
            laws.check_effective_shear(scene, pair, NAME)
        angles, rows = _angles(scene, pairs)
        matchers += [_matches("betas", betan), _matches("friction", angles)]
        material_rows += rows
        physics += ", frictAngle=friction"
    else:
        matchers.append('betas = MatchMaker(algo="val", val=0)')
    law_key = "ScGeom_MindlinPhys_Mindlin"
    rows = [Row("model.normal.law", normal.law, "Law2", law_key, "-", note)]
    if normal.law == "dmt":
        energy, row = _surface_energy(scene, pairs)
        physics += f", gamma={energy}"
        law_words.append("includeAdhesion=True")
        rows.append(row)
    rolling = moments.words(scene, pairs)
    rows.append(_cut_row(scene))
    return Words(
        material="FrictMat",
        physics="Ip2_FrictMat_FrictMat_MindlinPhys",
        law=f"Law2_{law_key}",
        constructors=_constructors(
            scene,
            "FrictMat",
            lambda index: (
                f"young={number(stiffness[index][0])}, poisson={number(stiffness[index][1])}, frictionAngle=0"
            ),
        ),
        matchers=matchers,
        physics_words=physics + rolling.physics,
        law_words=", ".join(law_words + rolling.law),
        comment="Hertz and dashpot" + (", DMT" if normal.law == "dmt" else "") + (", friction" if sliding else ""),
        material_rows=material_rows,
        model_rows=rows + rolling.rows,
        materials_comment="friction by pair" if sliding else "frictionless",
    )


def _cut_row(scene: Scene) -> Row:
    note = {"dmt": "the dashpot pulls at most as the adhesion", "luding_hysteretic": "YADE never cuts"}
    stated, law = scene.model.normal.force_cut, scene.model.normal.law
    return Row("model.normal.force_cut", stated, "(no key)", force_cut(scene), "-", note.get(law, "YADE always cuts"))


def _surface_energy(scene: Scene, pairs: list[Pair]) -> tuple[str, Row]:
    """The one `gamma` [J/m2] of all pairs."""
    works = {laws.coefficient(scene, pair, "work_of_adhesion", pair.work_of_adhesion) for pair in pairs}
    if len(works) > 1:
        raise NotComparable("YADE has one surface energy for all pairs, the scene states several works of adhesion")
    work = works.pop() if works else 0.0
    energy = number(0.5 * work)
    return energy, Row("pairs[*].work_of_adhesion", number(work), "gamma", energy, "J/m2", "W / 2, includeAdhesion")


def _linear(scene: Scene, pairs: list[Pair], law: LinearSpringDashpot) -> Words:
    """ViscElMat."""
    tangential = scene.model.tangential
    if scene.model.moments.law != "free":
        raise NotComparable("YADE has a rolling spring beside MindlinPhys only, not beside ViscElMat")
    values = [
        ("stiffness", "kn", law.stiffness, 2.0 * law.stiffness, "N/m"),
        ("dashpot", "cn", law.dashpot, 2.0 * law.dashpot, "kg/s"),
    ]
    rows = [Row("model.normal.law", law.law, "Law2", "ScGeom_ViscElPhys_Basic", "-", "pairs get k1 k2 / (k1 + k2)")]
    rows += [
        Row(f"model.normal.{key}", number(v), f"ViscElMat {k}", number(typed), unit, "2 x")
        for key, k, v, typed, unit in values
    ]
    rows.append(_cut_row(scene))
    shear = {"ks": 0.0, "cs": 0.0}
    matchers = ['friction = MatchMaker(algo="val", val=0)']
    pair_rows: list[Row] = []
    if isinstance(tangential, LinearHistory):
        shear = {"ks": 2.0 * tangential.stiffness_ratio * law.stiffness, "cs": 2.0 * tangential.dashpot}
        ratio, dashpot = number(tangential.stiffness_ratio), number(tangential.dashpot)
        rows.append(
            Row("model.tangential.stiffness_ratio", ratio, "ViscElMat ks", number(shear["ks"]), "N/m", "2 ratio k")
        )
        rows.append(Row("model.tangential.dashpot", dashpot, "ViscElMat cs", number(shear["cs"]), "kg/s", "2 x"))
        angles, pair_rows = _angles(scene, pairs)
        matchers = [_matches("friction", angles)]
    text = ", ".join(
        f"{key}={number(value)}" for key, value in {"kn": values[0][3], "cn": values[1][3], **shear}.items()
    )
    sliding = laws.frictional(scene)
    return Words(
        material="ViscElMat",
        physics="Ip2_ViscElMat_ViscElMat_ViscElPhys",
        law="Law2_ScGeom_ViscElPhys_Basic",
        constructors=_constructors(scene, "ViscElMat", lambda _: f"{text}, frictionAngle=0"),
        matchers=matchers,
        physics_words="frictAngle=friction",
        law_words="",
        comment="linear spring and dashpot" + (", friction" if sliding else ""),
        material_rows=pair_rows,
        model_rows=rows,
        materials_comment="friction by pair" if sliding else "frictionless",
    )


def _luding(scene: Scene, law: LudingHysteretic) -> Words:
    """LudingMat: pairs get the harmonic mean of both materials, which are equal here."""
    if scene.model.moments.law != "free" or laws.frictional(scene):
        raise NotComparable("friction and moments beside luding_hysteretic have no translation in YADE (known: none)")
    if law.dashpot > 0 and not capability.head_on(scene):
        raise NotComparable(
            "YADE damps the slip of LudingPM as it damps the approach, whatever the friction: head-on only"
        )
    # G0 damps the shear too, without a limit: a head-on impact has none.
    values = {"k1": law.k1, "kp": law.kp, "kc": law.kc, "ks": 0.0, "PhiF": law.plasticity_depth, "G0": law.dashpot}
    text = ", ".join(f"{key}={number(value)}" for key, value in values.items())
    rows = [Row("model.normal.law", law.law, "Law2", "ScGeom_LudingPhys_Basic", "-", "walls are elastic with kp")]
    for name, key, unit in (
        ("k1", "k1", "N/m"),
        ("kp", "kp", "N/m"),
        ("kc", "kc", "N/m"),
        ("plasticity_depth", "PhiF", "-"),
        ("dashpot", "G0", "kg/s"),
    ):
        stated = number(values[key])
        rows.append(Row(f"model.normal.{name}", stated, f"LudingMat {key}", stated, unit, "as stated"))
    return Words(
        material="LudingMat",
        physics="Ip2_LudingMat_LudingMat_LudingPhys",
        law="Law2_ScGeom_LudingPhys_Basic",
        constructors=_constructors(scene, "LudingMat", lambda _: f"{text}, frictionAngle=0"),
        matchers=[],
        physics_words="",
        law_words="",
        comment="k1, kp, kc with hysteresis",
        material_rows=[],
        model_rows=[*rows, _cut_row(scene)],
    )
