"""Rolling and twisting resistance in the words of YADE (MindlinPhys with includeMoment).

krot and ktwist are the same for all contacts. The bending moment is capped at eta F_n (refR1 + refR2) / 2, not at all
where eta = 0; the twisting moment never is.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from cross_check.adapters import laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.render import number
from cross_check.contact_model import ElasticPlasticRolling
from cross_check.scene import Pair, Scene

# Radius that Ig2_Wall_Sphere_ScGeom(hertzian=True) gives a wall, in radii of the sphere [-].
PLANE_RADIUS_FACTOR = 1e8


@dataclass(frozen=True)
class Words:
    """Words of the interaction physics and of the law functor, and the translation."""

    physics: str = ""
    law: list[str] = field(default_factory=list[str])
    rows: list[Row] = field(default_factory=list[Row])


def words(scene: Scene, pairs: list[Pair]) -> Words:
    """The moment law of `scene`. Raises NotComparable or InvalidScene with the reason."""
    law = scene.model.moments
    if not isinstance(law, ElasticPlasticRolling):
        return Words()
    krot, eta, ktwist = stiffness(scene, law, pairs), _eta(scene, law, pairs), _twisting(law)
    kind, stated = law.stiffness.kind, number(law.stiffness.value or 0.0)
    formula = "as stated" if kind == "constant" else "value R*^2"
    rows = [
        Row("model.moments.law", law.law, "includeMoment", "True", "-", "moments that turn with the contact"),
        Row("model.moments.stiffness.value", stated, "krot", number(krot), "N m", formula),
        Row("model.moments.limit", law.limit, "eta", number(eta), "-", "mu_r R* / mean radius; 0: no cap"),
        Row("model.moments.twisting", law.twisting.kind, "ktwist", number(ktwist), "N m", "never capped"),
    ]
    physics = f", krot={number(krot)}, eta={number(eta)}, ktwist={number(ktwist)}"
    return Words(physics, ["includeMoment=True"], rows)


def stiffness(scene: Scene, law: ElasticPlasticRolling, pairs: list[Pair]) -> float:
    """Rolling stiffness [N m] of all contacts."""
    value = law.stiffness.value or 0.0
    if law.dashpot.kind != "none":
        raise NotComparable(f"YADE has no rolling dashpot, the scene asks for {law.dashpot.kind}")
    if law.stiffness.kind == "constant":
        return value
    if law.stiffness.kind != "per_radius_squared":
        raise NotComparable(f"YADE's rolling stiffness does not follow the overlap, {law.stiffness.kind} does")
    found = {laws.effective_radius(both) ** 2 * value for pair in pairs for both in _contacts(scene, pair)}
    return laws.one_value(found, "YADE: krot")


def _contacts(scene: Scene, pair: Pair) -> set[tuple[float, float]]:
    return laws.radii(scene, pair, PLANE_RADIUS_FACTOR)


def _eta(scene: Scene, law: ElasticPlasticRolling, pairs: list[Pair]) -> float:
    """The cap of all contacts, over the normal force and the mean radius [-]."""
    if law.limit == "unlimited":
        return 0.0
    found: set[float] = set()
    for pair in pairs:
        friction = laws.rolling_friction(scene, pair)
        found |= {friction * laws.effective_radius(both) / (0.5 * sum(both)) for both in _contacts(scene, pair)}
    eta = laws.one_value(found, "YADE: eta = mu_r R* / mean radius")
    if eta == 0:
        raise NotComparable("YADE reads eta = 0 as a rolling spring without a cap, the scene caps it at zero")
    return eta


def _twisting(law: ElasticPlasticRolling) -> float:
    """Twisting stiffness [N m]."""
    twisting = law.twisting
    if twisting.kind == "none":
        return 0.0
    if twisting.kind != "constant" or twisting.dashpot or twisting.arm is not None:
        raise NotComparable(
            f"YADE's twisting is a constant spring without dashpot and cap, not {twisting.kind} with them"
        )
    return twisting.stiffness or 0.0
