"""Known differences: which option of a mirror stands behind a difference, and what it means."""

from __future__ import annotations

import functools
from typing import Any

from cross_check import PACKAGE, toml_file
from cross_check.scene import Cylinder, Plane, Scene


class UnknownDifference(Exception):
    """Two scenes differ in an option that known_differences.toml does not explain."""


@functools.cache
def known() -> dict[str, dict[str, Any]]:
    """The table of known differences by identifier: `option`, `law_term`, `explanation`, `codes`."""
    return toml_file.read(PACKAGE / "known_differences.toml")


def _cut(scene: Scene) -> bool:
    """Whether the engine cuts the normal force of the scene at zero; without damping nothing is ever cut."""
    damped = any(pair.damping_ratio > 0.0 for pair in scene.pairs)
    return damped and scene.model.normal.force_cut != "off"


def _options(scene: Scene) -> dict[str, Any]:
    planes = any(isinstance(body.shape, Plane) for body in scene.bodies)
    cylinders = any(isinstance(body.shape, Cylinder) for body in scene.bodies)
    return {
        "force_cut": _cut(scene),
        "plane_radius_factor": scene.mirror.plane_radius_factor if planes else None,
        "cylinder_curvature": scene.mirror.cylinder_curvature if cylinders else None,
        "start": scene.mirror.start,
    }


def cause(plain: Scene, mirror: Scene) -> str:
    """Identifiers of the options in which a mirror differs from the plain scene, joined by `+`.

    Raises UnknownDifference where there is none, or one without an explanation.
    """
    left, right = _options(plain), _options(mirror)
    differing = [name for name in left if left[name] != right[name]]
    by_option = {entry["option"]: identifier for identifier, entry in known().items()}
    # The staggered start changes what is stored, not the trajectory: it never explains a difference of positions.
    effective = [name for name in differing if name != "start"] or differing
    unexplained = [name for name in effective if name not in by_option]
    if unexplained or not effective:
        raise UnknownDifference(f"no known difference explains the options {', '.join(unexplained) or '(none differ)'}")
    return "+".join(by_option[name] for name in effective)
