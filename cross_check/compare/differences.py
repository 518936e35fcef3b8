"""Known differences: which option of a mirror stands behind a difference, and what it means."""

from __future__ import annotations

import functools
from typing import Any

from cross_check import PACKAGE, toml_file
from cross_check.contact_model import (
    ConstantTorque,
    ElasticPlasticRolling,
    LinearHistory,
    LinearSpringDashpot,
    LudingHysteretic,
    Mindlin,
)
from cross_check.mirror_options import (
    Arms,
    RollingOptions,
    TangentialOptions,
    TwistingOptions,
    TwistingSpring,
)
from cross_check.scene import Cylinder, Plane, Scene

MID_OVERLAP = Arms("mid_overlap", "mid_overlap")


class UnknownDifference(Exception):
    """Two scenes differ in an option that known_differences.toml does not explain."""


@functools.cache
def known() -> dict[str, dict[str, Any]]:
    """The table of known differences by identifier: `option`, `law_term`, `explanation`, `codes`."""
    return toml_file.read(PACKAGE / "known_differences.toml")


def _damped(scene: Scene) -> bool:
    law = scene.model.normal
    if isinstance(law, LinearSpringDashpot | LudingHysteretic):
        return law.dashpot > 0.0
    return any(pair.damping_ratio > 0.0 for pair in scene.pairs)


def _cut(scene: Scene) -> bool:
    """Whether the engine cuts the normal force of the scene at zero; without damping nothing is ever cut."""
    return _damped(scene) and scene.model.normal.force_cut != "off"


def _adhesive(scene: Scene) -> bool:
    return scene.model.normal.law in ("dmt", "sjkr", "sjkr2")


def _curved(scene: Scene) -> bool:
    """Whether a law asks for R*. `LudingHysteretic` has it in the plastic range, where its rule says what a wall is."""
    linear = isinstance(scene.model.normal, LinearSpringDashpot | LudingHysteretic)
    return not linear or scene.model.moments.law != "free"


def _turns(scene: Scene) -> bool:
    """Whether the normal of the contact turns, or the sphere about it: at a plane a spring stays as it lies."""
    normals = [body.shape.normal for body in scene.bodies if isinstance(body.shape, Plane)]
    if len(normals) < len(scene.bodies) or not normals:
        return True
    spins = [particle.angular_velocity for particle in scene.particles]
    spins += [leg.angular_velocity for drive in scene.drives for leg in drive.legs]
    return any(sum(a * b for a, b in zip(spin, normal, strict=True)) != 0.0 for spin in spins for normal in normals)


def _tangential(scene: Scene) -> TangentialOptions:
    """The options of the mirror, or those of the plain engine (`src/laws/tangential.rs`)."""
    if scene.mirror.tangential is not None:
        return scene.mirror.tangential
    law = scene.model.tangential
    stated = law.history if isinstance(law, Mindlin) else "default"
    return TangentialOptions(
        history="force_rescaled" if stated == "default" else stated,
        rotation="rigid",
        order="rotate_first",
        increment="mean",
        cap="total",
        friction="without_adhesion",
        pair_arms=MID_OVERLAP,
        wall_arms=MID_OVERLAP,
    )


def _tangential_choices(scene: Scene) -> dict[str, Any]:
    """The choices of a tangential spring that matter in this scene."""
    law = scene.model.tangential
    if law.law == "frictionless":
        return {}
    options = _tangential(scene)
    # A linear spring of constant stiffness is the same as a displacement and as a force, whatever an increment takes.
    varies = not isinstance(law, LinearHistory)
    shear = law.dashpot > 0.0 if isinstance(law, LinearHistory) else _damped(scene)
    return {
        "history": options.history if varies else None,
        # A displacement has no increment of force.
        "increment": options.increment if varies and options.history != "displacement" else "mean" if varies else None,
        "rotation": (options.rotation, options.order) if _turns(scene) else None,
        "cap": options.cap if shear else None,
        "friction": options.friction if _adhesive(scene) else None,
        "arms": options.wall_arms if scene.bodies else options.pair_arms,
    }


def _moment_choices(scene: Scene) -> dict[str, Any]:
    """The choices of rolling and twisting springs."""
    law = scene.model.moments
    if isinstance(law, ConstantTorque):
        return {"opposed": scene.mirror.opposed or ("whole_spin" if law.torsion else "rolling")}
    if not isinstance(law, ElasticPlasticRolling):
        return {}
    plain = RollingOptions(
        stiffness=law.stiffness,
        limit=law.limit,
        dashpot=law.dashpot,
        history="force_rescaled",
        rotation="rigid",
        cap="total",
        torsion=law.twisting.kind == "joint",
        stretched_at_walls=False,
    )
    choices: dict[str, Any] = {"rolling": scene.mirror.rolling or plain}
    kind = law.twisting.kind
    if kind in ("spot", "constant"):
        stated = law.twisting
        constant = TwistingSpring("constant", stated.stiffness, stated.dashpot, stated.arm)
        spring = constant if kind == "constant" else TwistingSpring(kind)
        choices["twisting"] = scene.mirror.twisting or TwistingOptions(spring, "force_rescaled", "rigid", "total")
    return choices


def _options(scene: Scene) -> dict[str, Any]:
    planes = any(isinstance(body.shape, Plane) for body in scene.bodies)
    cylinders = any(isinstance(body.shape, Cylinder) for body in scene.bodies)
    hysteretic = isinstance(scene.model.normal, LudingHysteretic)
    return {
        "force_cut": _cut(scene),
        "plane_radius_factor": scene.mirror.plane_radius_factor if planes and _curved(scene) else None,
        "cylinder_curvature": scene.mirror.cylinder_curvature if cylinders else None,
        "start": scene.mirror.start,
        "dashpot_limit": (scene.mirror.dashpot_limit or "base") if _adhesive(scene) and _damped(scene) else None,
        "hysteresis": (scene.mirror.hysteresis or "self_consistent") if hysteretic else None,
        **_tangential_choices(scene),
        **_moment_choices(scene),
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
