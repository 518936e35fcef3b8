"""The engine options that reproduce YADE: always cut, walls as spheres of 1e8 radii, velocities at half steps."""

from __future__ import annotations

from cross_check.adapters.capability import mirrored
from cross_check.adapters.yade.translate import PLANE_RADIUS_FACTOR, force_cut
from cross_check.scene import Scene


def mirror(scene: Scene) -> Scene:
    """`scene` as the native engine must run it to repeat YADE."""
    return mirrored(scene, force_cut(scene), PLANE_RADIUS_FACTOR, "staggered")
