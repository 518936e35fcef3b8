"""The contact laws of a scene in the words of LAMMPS (pair_style granular, fix wall/gran granular).

Hertz: F = KN a d + c sqrt(KN a m*) v. KN and KT are always typed (this version forms a wrong E* and G* at walls by
itself) and c comes from the damping word `tsuji` as a polynomial of the number typed. `limit_damping` cuts the sum at
zero. The tangential dashpot is XT times the normal one.
"""

from __future__ import annotations

import math

from cross_check.adapters import capability, laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.lammps import moments
from cross_check.adapters.render import number
from cross_check.contact_model import LinearHistory, LinearSpringDashpot
from cross_check.scene import Pair, Scene

KNOWN = laws.Known(
    "LAMMPS",
    normal=("hertz", "linear_spring_dashpot", "dmt"),
    tangential=("frictionless", "mindlin", "linear_history"),
    moments=("free", "elastic_plastic_rolling"),
)
# The fit that LAMMPS evaluates for `damping tsuji`, by rising powers of the number typed.
TSUJI = (1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218)
# The first one is for scenes that leave it to the code.
HISTORIES = ("displacement", "force", "force_rescaled")
STYLES = {"displacement": "mindlin", "force": "mindlin/force", "force_rescaled": "mindlin_rescale/force"}
FRICTIONLESS = "tangential linear_nohistory 0 0"


def force_cut(scene: Scene) -> str:
    """`on` or `off`; LAMMPS does not cut when nothing is said, and has no cut for DMT."""
    if scene.model.normal.law == "dmt":
        if scene.model.normal.force_cut == "on" and laws.damped(scene, capability.touching(scene)):
            raise NotComparable("LAMMPS does not limit the damping of dmt, the scene cuts the force of the dashpot")
        return "off"
    return capability.resolved_cut(scene, default="off")


def tsuji_number(damping_ratio: float) -> float:
    """The number to type after `tsuji` [-] so that the fit gives c = sqrt(5) b; it is no restitution.

    The fit falls all the way to below zero at 1.01 (it is 3e-4 at 1), so the root is found by halving; strong dashpots
    need a negative number.
    """
    wanted = math.sqrt(5.0) * damping_ratio

    def fit(x: float) -> float:
        value = 0.0
        for factor in reversed(TSUJI):
            value = value * x + factor
        return value

    low, high = -1.0, 1.01
    while fit(low) < wanted:
        low *= 2.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fit(middle) > wanted else (low, middle)
    return 0.5 * (low + high)


def history(scene: Scene) -> str:
    """What the tangential spring remembers."""
    return laws.history(scene, KNOWN.code, HISTORIES)


def check(scene: Scene) -> None:
    """Raises NotComparable or InvalidScene for a model without translation."""
    laws.check(scene)
    normal, law = scene.model.normal, scene.model.tangential
    if normal.law == "dmt" and law.law != "frictionless":
        raise NotComparable(
            "this version of LAMMPS forms the friction cap of dmt from a variable that it never sets: frictionless only"
        )
    if (
        isinstance(law, LinearHistory)
        and isinstance(normal, LinearSpringDashpot)
        and law.dashpot > 0.0 == normal.dashpot
    ):
        raise NotComparable("LAMMPS states the tangential dashpot as a multiple of the normal one, which is 0")


def _normal(pair: Pair, scene: Scene) -> tuple[str, str]:
    """The words of the normal law and the damping word."""
    law = scene.model.normal
    if isinstance(law, LinearSpringDashpot):
        return f"hooke {number(law.stiffness)} {number(law.dashpot)}", "velocity"
    damping, constant = ("tsuji", tsuji_number(pair.damping_ratio)) if pair.damping_ratio > 0 else ("velocity", 0.0)
    if law.law == "dmt":
        # E with nu = 0, of which pairs and walls form the same E* = E / 2.
        energy = 0.5 * laws.coefficient(scene, pair, "work_of_adhesion", pair.work_of_adhesion)
        return f"dmt {number(2.0 * pair.effective_young)} {number(constant)} 0 {number(energy)}", damping
    return f"hertz {number(4.0 / 3.0 * pair.effective_young)} {number(constant)}", damping


def _tangential(scene: Scene, pair: Pair) -> str:
    law, normal = scene.model.tangential, scene.model.normal
    if law.law == "frictionless":
        return FRICTIONLESS
    friction = number(laws.friction(scene, pair))
    if isinstance(law, LinearHistory) and isinstance(normal, LinearSpringDashpot):
        ratio = law.dashpot / normal.dashpot if normal.dashpot > 0 else 0.0
        stiffness = law.stiffness_ratio * normal.stiffness
        return f"tangential linear_history {number(stiffness)} {number(ratio)} {friction}"
    shear = laws.effective_shear(scene, pair)
    ratio = math.sqrt(4.0 * shear / pair.effective_young)
    return f"tangential {STYLES[history(scene)]} {number(8.0 * shear)} {number(ratio)} {friction}"


def coefficients(scene: Scene, pair: Pair) -> str:
    """The words after `pair_coeff I J`, the same ones that a wall takes."""
    normal, damping = _normal(pair, scene)
    limit = " limit_damping" if force_cut(scene) == "on" else ""
    rolling = moments.words(scene, pair)
    return f"{normal} {_tangential(scene, pair)}{rolling} damping {damping}{limit}"


def no_contact(scene: Scene) -> str:
    """A contact without stiffness, for atom types that never touch."""
    normal = {"hertz": "hertz 0 0", "dmt": "dmt 0 0 0 0"}.get(scene.model.normal.law, "hooke 0 0")
    law = scene.model.tangential.law
    style = STYLES[history(scene)] if law == "mindlin" else law
    tangential = FRICTIONLESS if law == "frictionless" else f"tangential {style} 0 0 0"
    return f"{normal} {tangential}{moments.no_contact(scene)} damping velocity"


def pair_rows(scene: Scene, pair: Pair) -> list[Row]:
    """The translation of the values of one pair."""
    key = capability.pair_key(scene, pair)
    rows = _normal_rows(scene, pair) if laws.elastic(scene) else []
    words = _tangential(scene, pair).split()
    if laws.frictional(scene):
        if scene.model.tangential.law == "mindlin":
            modulus, shear = number(pair.effective_young), number(laws.effective_shear(scene, pair))
            rows.append(Row(f"{key}.effective_shear", shear, f"{words[1]} KT", words[2], "Pa", "8 G*"))
            rows.append(Row(f"{key}.effective_young", modulus, f"{words[1]} XT", words[3], "-", "sqrt(4 G*/E*)"))
        rows.append(Row(f"{key}.friction", words[4], f"{words[1]} XMU", words[4], "-", "as stated"))
    return rows + moments.rows(scene, pair)


def _normal_rows(scene: Scene, pair: Pair) -> list[Row]:
    key = capability.pair_key(scene, pair)
    words = _normal(pair, scene)[0].split()
    modulus, ratio = number(pair.effective_young), number(pair.damping_ratio)
    if words[0] == "dmt":
        energy = number(pair.work_of_adhesion or 0.0)
        rows = [
            Row(f"{key}.effective_young", modulus, "dmt E", words[1], "Pa", "2 E* with nu = 0"),
            Row(f"{key}.work_of_adhesion", energy, "dmt COH", words[4], "J/m2", "W / 2"),
        ]
    else:
        rows = [Row(f"{key}.effective_young", modulus, "hertz KN", words[1], "Pa", "4/3 E*")]
    if pair.damping_ratio > 0:
        damping = Row(f"{key}.damping_ratio", ratio, "damping tsuji ET", words[2], "-", "root of tsuji(ET) = sqrt(5) b")
    else:
        damping = Row(f"{key}.damping_ratio", ratio, "damping velocity GAMMA", words[2], "kg/s", "no dashpot")
    return [*rows, damping]


def model_rows(scene: Scene) -> list[Row]:
    """The translation of the laws of the model."""
    normal, law = scene.model.normal, scene.model.tangential
    style = "frictionless: linear_nohistory 0 0" if not laws.frictional(scene) else normal.law
    rows = [Row("model.normal.law", normal.law, "pair_style", "granular", "-", style)]
    if isinstance(normal, LinearSpringDashpot):
        stiffness, dashpot = number(normal.stiffness), number(normal.dashpot)
        rows.append(Row("model.normal.stiffness", stiffness, "hooke KN", stiffness, "N/m", "as stated"))
        rows.append(Row("model.normal.dashpot", dashpot, "hooke GAMMAN", dashpot, "kg/s", "damping velocity"))
    cut = force_cut(scene)
    rows.append(
        Row("model.normal.force_cut", normal.force_cut, "limit_damping", cut, "-", "default: off, the force may pull")
    )
    if isinstance(law, LinearHistory) and isinstance(normal, LinearSpringDashpot):
        stiffness = number(law.stiffness_ratio * normal.stiffness)
        ratio = number(law.dashpot / normal.dashpot if normal.dashpot > 0 else 0.0)
        name = "linear_history"
        rows.append(
            Row(
                "model.tangential.stiffness_ratio",
                number(law.stiffness_ratio),
                f"{name} KT",
                stiffness,
                "N/m",
                "ratio KN",
            )
        )
        rows.append(Row("model.tangential.dashpot", number(law.dashpot), f"{name} XT", ratio, "-", "dashpot / GAMMAN"))
    elif laws.frictional(scene):
        own = history(scene)
        rows.append(Row("model.tangential.law", law.law, "tangential", STYLES[own], "-", f"keeps a {own}"))
    return rows


def comment(scene: Scene) -> str:
    """What the contacts are, for the reader of the deck."""
    names = {"hertz": "Hertz and dashpot", "dmt": "DMT and dashpot"}
    normal = names.get(scene.model.normal.law, "linear spring and dashpot")
    return f"{normal}, {'friction' if laws.frictional(scene) else 'frictionless'}"
