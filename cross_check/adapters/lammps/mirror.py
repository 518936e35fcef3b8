"""The engine options that reproduce LAMMPS (design.md section 4)."""

from __future__ import annotations

from cross_check.adapters import laws as contact_laws
from cross_check.adapters.capability import has_tube, mirrored
from cross_check.adapters.lammps.laws import KNOWN, force_cut, history
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
    """A cap on elastic and damping parts together, full radii in the slip velocity, and in the torque of walls.

    Evaluated before the first step, no spring is stretched: where a dashpot alone passes the cap, nothing acts.
    """
    return TangentialOptions(
        history=history(scene),
        rotation="projection_rescaled",
        order="rotate_first",
        increment="present",
        cap="total_when_stretched",
        friction="total",
        pair_arms=Arms("radius", "mid_overlap"),
        wall_arms=Arms("radius", "radius"),
    )


def _rolling(scene: Scene) -> RollingOptions | None:
    """A rolling displacement that is projected and stretched; the cap holds spring and dashpot together, as above."""
    law = contact_laws.rolling(scene)
    if law is None:
        return None
    return RollingOptions(
        stiffness=law.stiffness,
        limit="effective_radius",
        dashpot=law.dashpot,
        history="displacement",
        rotation="projection_rescaled",
        cap="total_when_stretched",
        torsion=False,
        stretched_at_walls=False,
    )


def _twisting(scene: Scene) -> TwistingOptions | None:
    """A twist whose capped moment is directed against the spin."""
    law = contact_laws.rolling(scene)
    if law is None or law.twisting.kind == "none":
        return None
    twisting = law.twisting
    constant = TwistingSpring("constant", twisting.stiffness, twisting.dashpot or 0.0, twisting.arm)
    spring = constant if twisting.kind == "constant" else TwistingSpring(twisting.kind)
    return TwistingOptions(spring, "displacement", "projection_rescaled", "total_along_rate")


def mirror(scene: Scene) -> Scene:
    """`scene` as the native engine must run it to repeat LAMMPS: no cut unless asked, planes without curvature.

    Raises NotComparable where the code lacks something.
    """
    contact_laws.comparable(scene, KNOWN)
    options = Mirror(
        code="lammps",
        plane_radius_factor=None,
        start="synchronized",
        # R* = 2 R Rc / (2 Rc - R).
        cylinder_curvature=0.5 if has_tube(scene) else None,
        tangential=_tangential(scene) if contact_laws.frictional(scene) else None,
        rolling=_rolling(scene),
        twisting=_twisting(scene),
    )
    return mirrored(scene, force_cut(scene), options)
