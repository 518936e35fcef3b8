"""Scenes with friction, moments and adhesion for the tests of the adapters."""

from __future__ import annotations

from dataclasses import replace

from cross_check.contact_model import (
    FRICTIONLESS,
    AreaCohesion,
    ConstantTorque,
    ElasticPlasticRolling,
    LinearHistory,
    LinearSpringDashpot,
    LudingHysteretic,
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


def adhesive_scenes(code: str) -> dict[str, Scene]:
    """Oblique collisions under the adhesive laws that a code has."""
    found: dict[str, Scene] = {}
    for place, whole in (("pair", scenes.oblique_pair()), ("floor", spinning_floor())):
        if code == "liggghts":
            for law in ("sjkr", "sjkr2"):
                for cut in ("on", "off"):
                    model = Model(AreaCohesion(law, cut, 2e5), MINDLIN)
                    name = f"{law}/{cut}/{place}"
                    found[name] = with_laws(whole, model, name, friction=0.3)
        else:
            # LAMMPS reads an unset variable in the friction cap of dmt: at a wall it was seen to be (R - d)^2.
            tangential = MINDLIN if code == "yade" else FRICTIONLESS
            model, name = Model(NormalModel("dmt", "default"), tangential), f"dmt/{place}"
            # Strong enough for the dashpot of YADE to meet its limit, weak enough for a rebound.
            found[name] = with_laws(whole, model, name, friction=0.3, work_of_adhesion=0.5)
    return found


def luding_scenes() -> dict[str, Scene]:
    """Impacts of the hysteretic law: below and beyond the plastic range, without and with a dashpot, and at a plane.

    Spheres that stick go on bouncing on the cohesive branch, unloading and loading again.
    """
    found: dict[str, Scene] = {}
    pair, floor = scenes.pair("off"), replace(scenes.floor(), gravity=scenes.ZERO)
    for name, whole, speed, kc, dashpot, depth in (
        ("part", pair, 1.0, 200.0, 0.0, 0.05),
        ("stick", pair, 0.3, 3000.0, 0.0, 0.05),
        ("damped", pair, 0.5, 500.0, 0.2, 0.05),
        ("limit", pair, 1.0, 500.0, 0.0, 0.01),
        ("floor", floor, 1.0, 500.0, 0.0, 0.05),
    ):
        law = LudingHysteretic(
            "luding_hysteretic", "off", k1=5e3, kp=2e4, kc=kc, plasticity_depth=depth, dashpot=dashpot
        )
        slowed = tuple(
            replace(p, velocity=(p.velocity[0] * speed, p.velocity[1] * speed, p.velocity[2] * speed))
            for p in whole.particles
        )
        scene = replace(whole, particles=slowed, steps=6000)
        found[name] = with_laws(scene, Model(law), f"luding/{name}")
    # The floor above is met with an overlap of rounding size, these in the midst of a step.
    part = found["floor"]
    ball = replace(part.particles[0], position=(0.0, 0.0, 5.0011e-3))
    found["floor/within"] = replace(part, particles=(ball,), variant="luding/floor/within")
    # Pulled back from the floor: the vertex of its path lies 0.3 steps behind the first of two steps with an overlap.
    weight = 10.0
    speed = weight * 20000.3 * part.time_step
    gap = speed * speed / (2.0 * weight) - 1.2e-12
    ball = replace(ball, position=(0.0, 0.0, 5e-3 + gap), velocity=(0.0, 0.0, -speed))
    found["floor/graze"] = replace(
        part, particles=(ball,), gravity=(0.0, 0.0, weight), steps=20100, variant="luding/floor/graze"
    )
    return found
