"""The engine options that reproduce YADE (design.md section 4)."""

from __future__ import annotations

from cross_check.adapters import laws as contact_laws
from cross_check.adapters.capability import mirrored, touching
from cross_check.adapters.yade import moments
from cross_check.adapters.yade.laws import KNOWN, force_cut
from cross_check.adapters.yade.moments import PLANE_RADIUS_FACTOR
from cross_check.contact_model import RollingDashpot, RollingStiffness
from cross_check.mirror_options import (
    Arms,
    Mirror,
    RollingOptions,
    TangentialOptions,
    TwistingOptions,
    TwistingSpring,
)
from cross_check.scene import Scene


def _tangential(scene: Scene) -> TangentialOptions:
    """A force that small angles turn before it grows, a cap on its elastic part, contact points in the wall plane."""
    return TangentialOptions(
        history="force",
        rotation="small_angles",
        order="rotate_first",
        increment="present",
        cap="elastic",
        friction="pull_off_added" if scene.model.normal.law == "dmt" else "total",
        pair_arms=Arms("mid_overlap", "mid_overlap"),
        wall_arms=Arms("surface", "surface"),
    )


def _rolling(scene: Scene) -> RollingOptions | None:
    """A moment that small angles turn, of constant stiffness; eta is chosen so that the cap is that of R*."""
    law = contact_laws.rolling(scene)
    if law is None:
        return None
    return RollingOptions(
        stiffness=RollingStiffness("constant", moments.stiffness(scene, law, touching(scene))),
        # A contact whose normal force is cut at zero has no cap.
        limit="while_pressed" if law.limit == "effective_radius" else law.limit,
        dashpot=RollingDashpot("none"),
        history="force",
        rotation="small_angles",
        cap="total",
        torsion=False,
        stretched_at_walls=False,
    )


def _twisting(scene: Scene) -> TwistingOptions | None:
    """A moment that small angles turn, never capped."""
    law = contact_laws.rolling(scene)
    if law is None or law.twisting.kind == "none":
        return None
    spring = TwistingSpring("constant", law.twisting.stiffness, 0.0, None)
    return TwistingOptions(spring, "force", "small_angles", "elastic")


def mirror(scene: Scene) -> Scene:
    """`scene` as the native engine must run it to repeat YADE: walls as spheres of 1e8 radii, half-step velocities.

    Raises NotComparable where the code lacks something.
    """
    contact_laws.comparable(scene, KNOWN)
    options = Mirror(
        code="yade",
        plane_radius_factor=PLANE_RADIUS_FACTOR,
        start="staggered",
        tangential=_tangential(scene) if contact_laws.frictional(scene) else None,
        rolling=_rolling(scene),
        twisting=_twisting(scene),
        dashpot_limit="pull_off" if scene.model.normal.law == "dmt" else None,
        hysteresis="luding_pm" if scene.model.normal.law == "luding_hysteretic" else None,
    )
    return mirrored(scene, force_cut(scene), options)
