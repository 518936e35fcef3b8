"""Materials of a scene and the values of their pairs (docs/formats.md)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Expansion:
    """Linear thermal expansion of radii: `coefficient` [1/K] about `reference_temperature` [K]."""

    coefficient: float
    reference_temperature: float


@dataclass(frozen=True)
class Material:
    """A material; `young` [Pa], `poisson` [-] and `density` [kg/m3] are None where the case states none.

    So is the thermal `expansion` of radii.
    """

    name: str
    rigid: bool
    young: float | None
    poisson: float | None
    density: float | None
    expansion: Expansion | None = None


@dataclass(frozen=True)
class Pair:
    """Mixed values of two materials: E* and G* [Pa], fraction of critical damping [-], restitution as asked [-].

    Coefficients of friction, rolling and twisting friction [-], work of adhesion [J/m2] and whether the contact may
    pull are None where no law of the model asks for them.
    """

    between: tuple[int, int]
    effective_young: float
    effective_shear: float | None
    damping_ratio: float
    restitution: float | None
    friction: float | None = None
    rolling_friction: float | None = None
    twisting_friction: float | None = None
    work_of_adhesion: float | None = None
    cohesive: bool | None = None


# Values of a pair that stand only where a law asks for them.
_OPTIONAL = ("friction", "rolling_friction", "twisting_friction", "work_of_adhesion", "cohesive")


def material_from_json(raw: dict[str, Any]) -> Material:
    """The typed view of a material."""
    typed = dict(raw)
    if "expansion" in raw:
        typed["expansion"] = Expansion(**raw["expansion"])
    return Material(**typed)


def material_to_json(material: Material) -> dict[str, Any]:
    """A material as the engine reads it."""
    raw = asdict(material)
    if material.expansion is None:
        del raw["expansion"]
    return raw


def pair_from_json(raw: dict[str, Any]) -> Pair:
    """The typed view of a pair."""
    first, second = raw["between"]
    typed = dict(raw)
    typed["between"] = (int(first), int(second))
    return Pair(**typed)


def pair_to_json(pair: Pair) -> dict[str, Any]:
    """A pair as the engine reads it."""
    return {key: value for key, value in asdict(pair).items() if key not in _OPTIONAL or value is not None}
