"""The hysteretic law in the words of LIGGGHTS: `model luding`.

kp and kc are typed as ratios to k1. The dashpot follows from a restitution: 2 b sqrt(m* k1), so it is one constant only
where all contacts have the same reduced mass. The force is cut only where kc = 0.
"""

from __future__ import annotations

import math

from cross_check.adapters import capability, laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.liggghts.properties import matrix
from cross_check.adapters.render import number
from cross_check.contact_model import LudingHysteretic
from cross_check.scene import Pair, Scene

# What LIGGGHTS accepts as coefficientRestitution.
LOWEST_RESTITUTION = 0.05


def words(scene: Scene, pairs: list[Pair], law: LudingHysteretic) -> tuple[list[str], list[Row]]:
    """Property commands and translation. Raises NotComparable with the reason."""
    if laws.frictional(scene):
        raise NotComparable("friction beside luding_hysteretic has no translation in LIGGGHTS (known: frictionless)")
    if law.dashpot > 0 and law.kc > 0 and scene.model.normal.force_cut == "on":
        raise NotComparable("LIGGGHTS cuts the dashpot of luding only where kc = 0, the scene cuts it")
    restitution = _restitution(scene, pairs, law)
    properties: list[str] = []
    rows = [Row("model.normal.law", law.law, "pair_style gran", "model luding", "-", "pullOffForce = 0")]
    for fix, name, key, stated, value, unit, formula in (
        ("loading", "k1", "LoadingStiffness", law.k1, law.k1, "N/m", "as stated"),
        ("unloading", "kp", "UnloadingStiffness", law.kp, law.kp / law.k1, "-", "kp / k1"),
        ("adhesion", "kc", "coefficientAdhesionStiffness", law.kc, law.kc / law.k1, "-", "kc / k1"),
        (
            "depth",
            "plasticity_depth",
            "coefficientPlasticityDepth",
            law.plasticity_depth,
            law.plasticity_depth,
            "-",
            "as stated",
        ),
        ("restitution", "dashpot", "coefficientRestitution", law.dashpot, restitution, "-", "g = 2 b sqrt(m* k1)"),
    ):
        properties += matrix(scene, fix, key, {}, never=number(value))
        rows.append(Row(f"model.normal.{name}", number(stated), key, number(value), unit, formula))
    return properties + matrix(scene, "pull_off", "pullOffForce", {}, never="0"), rows


def _restitution(scene: Scene, pairs: list[Pair], law: LudingHysteretic) -> float:
    """CoefficientRestitution [-] that gives the dashpot constant of the law."""
    if law.dashpot == 0:
        return 1.0
    masses = {mass for pair in pairs for mass in laws.reduced_masses(scene, pair)}
    shares = {law.dashpot / (2.0 * math.sqrt(mass * law.k1)) for mass in masses}
    share = laws.one_value(shares, "LIGGGHTS: the fraction of critical damping of luding")
    value = 0.0 if share >= 1.0 else math.exp(-math.pi * share / math.sqrt(1.0 - share**2))
    if value <= LOWEST_RESTITUTION:
        key = capability.pair_key(scene, pairs[0])
        raise NotComparable(
            f"{key}: the dashpot needs coefficientRestitution {number(value)}, LIGGGHTS needs above 0.05"
        )
    return value
