"""The engine options that reproduce LIGGGHTS (design.md section 4)."""

from __future__ import annotations

from cross_check.adapters import laws as contact_laws
from cross_check.adapters.capability import has_tube, mirrored
from cross_check.adapters.liggghts.laws import KNOWN, force_cut
from cross_check.contact_model import ConstantTorque
from cross_check.mirror_options import Arms, Mirror, RollingOptions, TangentialOptions
from cross_check.scene import Scene

MID = Arms("mid_overlap", "mid_overlap")
# A displacement that grows, is then projected on the contact plane; a cap on the elastic part, which sees no cohesion.
TANGENTIAL = TangentialOptions(
    history="displacement",
    rotation="projection",
    order="increment_first",
    increment="present",
    cap="elastic",
    friction="without_adhesion",
    pair_arms=MID,
    wall_arms=MID,
)


def _rolling(scene: Scene) -> RollingOptions | None:
    """A torque that is not turned, its elastic part capped; at walls the spin is stretched."""
    law = contact_laws.rolling(scene)
    if law is None:
        return None
    return RollingOptions(
        stiffness=law.stiffness,
        limit="effective_radius",
        dashpot=law.dashpot,
        history="force",
        rotation="fixed",
        cap="elastic",
        torsion=law.twisting.kind == "joint",
        stretched_at_walls=True,
        # The evaluation before the first step stretches rolling springs, though not tangential ones, and forgets it.
        setup_step=scene.time_step,
    )


def _opposed(scene: Scene) -> str | None:
    """The constant torque is normalised with the whole spin, even where the part along the normal is dropped."""
    law = scene.model.moments
    if not isinstance(law, ConstantTorque):
        return None
    return "whole_spin" if law.torsion else "rolling_share"


def mirror(scene: Scene) -> Scene:
    """`scene` as the native engine must run it to repeat LIGGGHTS: no cut unless asked, planes without curvature.

    Raises NotComparable where the code lacks something.
    """
    contact_laws.comparable(scene, KNOWN)
    options = Mirror(
        code="liggghts",
        plane_radius_factor=None,
        start="synchronized",
        # A cylinder acts like a plane.
        cylinder_curvature=0.0 if has_tube(scene) else None,
        tangential=TANGENTIAL if contact_laws.frictional(scene) else None,
        rolling=_rolling(scene),
        opposed=_opposed(scene),
        hysteresis="old_stiffness" if scene.model.normal.law == "luding_hysteretic" else None,
    )
    return mirrored(scene, force_cut(scene), options)
