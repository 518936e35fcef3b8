"""The engine options that reproduce YADE (design.md section 4)."""

from __future__ import annotations

from cross_check.adapters import laws as contact_laws
from cross_check.adapters.capability import mirrored
from cross_check.adapters.yade.laws import PLANE_RADIUS_FACTOR, force_cut
from cross_check.mirror_options import Arms, Mirror, TangentialOptions
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


def mirror(scene: Scene) -> Scene:
    """`scene` as the native engine must run it to repeat YADE: walls as spheres of 1e8 radii, half-step velocities."""
    options = Mirror(
        plane_radius_factor=PLANE_RADIUS_FACTOR,
        start="staggered",
        tangential=_tangential(scene) if contact_laws.frictional(scene) else None,
    )
    return mirrored(scene, force_cut(scene), options)
