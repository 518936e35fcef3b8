"""Rolling and twisting resistance in the words of LIGGGHTS: cdt, epsd, epsd2, epsd3.

The torque that a contact remembers is not turned with it, and a capped one loses its dashpot. `torsionTorque on` leaves
the part of the spin along the normal in the same spring, with the same cap.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from cross_check.adapters import capability, laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.liggghts.properties import matrix, pair_rows
from cross_check.adapters.render import number
from cross_check.contact_model import ConstantTorque, ElasticPlasticRolling
from cross_check.scene import Pair, Scene

# Factor of kn mu_r^2 R*^2 in `epsd`; `epsd3` has its own.
EPSD_FACTOR = 2.25
FRICTION = "coefficientRollingFriction"
VISCOUS = "coefficientRollingViscousDamping"
STIFFNESS = "rollingStiffness"


@dataclass(frozen=True)
class Words:
    """Words after `model`, settings, comment, property commands and translation of a moment law."""

    model: str = ""
    settings: str = ""
    comment: str = ""
    properties: list[str] = field(default_factory=list[str])
    pair_rows: list[Row] = field(default_factory=list[Row])
    rows: list[Row] = field(default_factory=list[Row])


def words(scene: Scene, pairs: list[Pair]) -> Words:
    """The moment law of `scene`. Raises NotComparable or InvalidScene with the reason."""
    law = scene.model.moments
    if law.law == "free":
        return Words()
    if not laws.frictional(scene):
        raise NotComparable("LIGGGHTS has rolling friction beside a tangential law only, the scene is frictionless")
    values, rows = pair_rows(
        scene, pairs, "rolling_friction", FRICTION, lambda pair: laws.rolling_friction(scene, pair)
    )
    properties = matrix(scene, "rolling", FRICTION, values, never="0")
    if isinstance(law, ElasticPlasticRolling):
        style, torsion, own, own_rows = _spring(scene, law)
    else:
        torsion = isinstance(law, ConstantTorque) and law.torsion
        style, own, own_rows = "cdt", list[str](), list[Row]()
    note = "torsionTorque on" if torsion else "acts across the normal"
    model = Row("model.moments.law", law.law, "rolling_friction", style, "-", note)
    settings = " torsionTorque on" if torsion else ""
    return Words(f" rolling_friction {style}", settings, ", rolling", properties + own, rows, [model, *own_rows])


def _spring(scene: Scene, law: ElasticPlasticRolling) -> tuple[str, bool, list[str], list[Row]]:
    """Style, whether torsion is on, property commands and rows of a rolling spring."""
    if law.limit != "effective_radius":
        raise NotComparable(f"LIGGGHTS caps rolling torques with R*, the scene asks for the limit {law.limit}")
    if law.twisting.kind not in ("none", "joint"):
        raise NotComparable(f"LIGGGHTS twists with the rolling spring or not at all, not as {law.twisting.kind}")
    torsion, stiffness, dashpot = law.twisting.kind == "joint", law.stiffness, law.dashpot
    if stiffness.kind == "tangential":
        if dashpot.kind != "none":
            raise NotComparable(f"LIGGGHTS has no dashpot beside the rolling stiffness kt R*^2, not {dashpot.kind}")
        return "epsd2", torsion, [], []
    if stiffness.kind != "normal":
        raise NotComparable(
            f"the rolling stiffness {stiffness.kind} has no translation in LIGGGHTS (tangential, normal)"
        )
    if dashpot.kind not in ("none", "critical_share"):
        raise NotComparable(f"the rolling dashpot {dashpot.kind} has no translation in LIGGGHTS (critical_share)")
    share, factor = dashpot.value or 0.0, stiffness.value or 0.0
    pairs = {pair.between: number(share) for pair in capability.touching(scene)}
    properties = matrix(scene, "rolling_dashpot", VISCOUS, pairs, never="0")
    rows = [Row("model.moments.dashpot.value", number(share), VISCOUS, number(share), "-", "as stated")]
    if factor == EPSD_FACTOR:
        return "epsd", torsion, properties, rows
    properties.append(f"fix rolling_stiffness all property/global {STIFFNESS} scalar {number(factor)}")
    rows.append(Row("model.moments.stiffness.value", number(factor), STIFFNESS, number(factor), "-", "as stated"))
    return "epsd3", torsion, properties, rows
