"""The engine options that reproduce LAMMPS: no cut unless asked, planes without curvature, synchronized start."""

from __future__ import annotations

from cross_check.adapters.capability import mirrored
from cross_check.adapters.lammps.translate import force_cut
from cross_check.scene import Scene


def mirror(scene: Scene) -> Scene:
    """`scene` as the native engine must run it to repeat LAMMPS."""
    return mirrored(scene, force_cut(scene), plane_radius_factor=None, start="synchronized")
