"""Scenes with friction, moments and adhesion for the tests of the adapters."""

from __future__ import annotations

from dataclasses import replace

from cross_check.contact_model import (
    ConstantTorque,
    ElasticPlasticRolling,
    LinearHistory,
    LinearSpringDashpot,
    Mindlin,
    Model,
    MomentModel,
    NormalModel,
    RollingDashpot,
    RollingStiffness,
    TwistingModel,
)
from cross_check.scene import Material, Pair, Scene

from . import scenes

MINDLIN = Mindlin("mindlin", "default")
LINEAR = Model(
    LinearSpringDashpot("linear_spring_dashpot", "on", stiffness=2e4, dashpot=0.2),
    LinearHistory("linear_history", stiffness_ratio=2 / 7, dashpot=0.1),
)


def effective_shear(first: Material, second: Material) -> float:
    """G* [Pa] of two materials; a rigid one adds no compliance."""
    compliance = 0.0
    for material in (first, second):
        if material.young is not None and material.poisson is not None:
            compliance += 2 * (2 - material.poisson) * (1 + material.poisson) / material.young
    return 1 / compliance


def with_laws(whole: Scene, model: Model, variant: str, **values: float) -> Scene:
    """The scene with another model and with `values` in every pair."""

    def stated(pair: Pair) -> Pair:
        first, second = (whole.materials[index] for index in pair.between)
        return replace(replace(pair, effective_shear=effective_shear(first, second)), **values)

    return replace(whole, model=model, pairs=tuple(stated(pair) for pair in whole.pairs), variant=variant)


def mindlin(whole: Scene, friction: float, variant: str, history: str = "default") -> Scene:
    """The scene with Hertz, Mindlin and friction."""
    model = Model(NormalModel("hertz", whole.model.normal.force_cut), Mindlin("mindlin", history))
    return with_laws(whole, model, variant, friction=friction)


def linear(whole: Scene, friction: float, variant: str) -> Scene:
    """The scene with linear springs, dashpots and friction, the normal force cut at zero."""
    return with_laws(whole, LINEAR, variant, friction=friction)


def frictional_scenes() -> dict[str, Scene]:
    """Oblique collisions with spin, of pairs and at walls: sticking, slipping, elastic, damped, at a sliding wall."""
    pair, spinning = scenes.oblique_pair(), spinning_floor()
    sliding = replace(scenes.moving_floor((0.3, 0.0, 0.0)), particles=spinning.particles)
    elastic = tuple(replace(item, damping_ratio=0.0, restitution=1.0) for item in pair.pairs)
    return {
        "mindlin/pair/stick": mindlin(pair, 0.9, "mindlin/pair/stick"),
        "mindlin/pair/slip": mindlin(pair, 0.1, "mindlin/pair/slip"),
        "mindlin/pair/elastic": mindlin(replace(pair, pairs=elastic), 0.3, "mindlin/pair/elastic"),
        "mindlin/floor": mindlin(spinning, 0.4, "mindlin/floor"),
        "mindlin/sliding": mindlin(sliding, 0.2, "mindlin/sliding"),
        "linear/pair/stick": linear(pair, 0.9, "linear/pair/stick"),
        "linear/pair/slip": linear(pair, 0.1, "linear/pair/slip"),
        "linear/floor": linear(spinning, 0.4, "linear/floor"),
    }


NO_TWIST = TwistingModel("none")
JOINT = TwistingModel("joint")


def rolling(
    stiffness: tuple[str, float | None],
    dashpot: tuple[str, float | None] = ("none", None),
    twisting: TwistingModel = NO_TWIST,
    limit: str = "effective_radius",
) -> ElasticPlasticRolling:
    """A rolling spring."""
    return ElasticPlasticRolling(
        "elastic_plastic_rolling", RollingStiffness(*stiffness), RollingDashpot(*dashpot), limit, twisting
    )


def with_moments(whole: Scene, moments: MomentModel, variant: str, friction: float = 0.3, rolls: float = 0.2) -> Scene:
    """The scene with Hertz, Mindlin and a moment law."""
    model = Model(NormalModel("hertz", whole.model.normal.force_cut), MINDLIN, moments)
    values = {"friction": friction, "rolling_friction": rolls, "twisting_friction": friction}
    return with_laws(whole, model, variant, **values)


def spinning_floor() -> Scene:
    """A sphere that falls on a plane and spins about all axes."""
    floor = scenes.floor()
    return replace(floor, particles=(replace(floor.particles[0], angular_velocity=(30.0, -40.0, 25.0)),))


def moment_laws() -> dict[str, dict[str, MomentModel]]:
    """By code the moment laws that it has: springs that stay below the cap (stiffness 1e-4 N m) and that pass it."""
    free_twist = TwistingModel("constant", 2e-3, 0.0, None)
    return {
        "liggghts": {
            "cdt": ConstantTorque("constant_torque", False),
            "cdt/torsion": ConstantTorque("constant_torque", True),
            "epsd": rolling(("normal", 2.25), ("critical_share", 0.3)),
            "epsd/undamped": rolling(("normal", 2.25)),
            "epsd2": rolling(("tangential", None)),
            "epsd2/torsion": rolling(("tangential", None), twisting=JOINT),
            "epsd3": rolling(("normal", 1.5), ("critical_share", 0.1)),
        },
        "yade": {
            "constant": rolling(("constant", 1e-3), twisting=free_twist),
            "stiff": rolling(("constant", 2e-1), twisting=free_twist),
            "unlimited": rolling(("constant", 2e-1), limit="unlimited"),
            "per_radius_squared": rolling(("per_radius_squared", 1e4)),
        },
        "lammps": {
            "constant": rolling(("constant", 1e-3), twisting=TwistingModel("constant", 2e-3, 1e-6, 1e-3)),
            "stiff": rolling(
                ("per_radius_squared", 1e5),
                ("per_radius_squared", 0.02),
                TwistingModel("constant", 5e-2, 1e-7, 5e-4),
            ),
            "spot": rolling(("per_radius_squared", 1e4), ("per_radius_squared", 0.01), TwistingModel("spot")),
        },
    }
