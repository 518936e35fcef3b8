"""What a contact is to the re-stated formulas: kinematics and memory."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cross_check.scene import Pair

Array = NDArray[np.float64]


@dataclass
class Contact:
    """Kinematics of one contact at one step."""

    pair: Pair
    normal: Array
    overlap: float
    radii: tuple[float, float]
    reduced_radius: float
    mass: float
    velocity: Array
    spins: tuple[Array, Array]
    wall: bool
    masses: tuple[float, float]

    @property
    def approach(self) -> float:
        """Normal velocity, positive when approaching [m/s]."""
        return -float(self.velocity @ self.normal)

    @property
    def spot(self) -> float:
        """Radius of the contact spot [m]."""
        return math.sqrt(self.reduced_radius * self.overlap)

    def arms(self, rule: str) -> tuple[float, float]:
        """Arms of both sides [m]; `half`: R - d/2, `full`: R, `plane`: R - d."""
        lost = {"half": 0.5, "full": 0.0, "plane": 1.0}[rule] * self.overlap
        own, other = self.radii
        return own - lost, 0.0 if self.wall else other - lost

    def slip(self, rule: str) -> Array:
        """Slip velocity [m/s]."""
        own, other = self.arms(rule)
        through = self.velocity - self.normal * float(self.velocity @ self.normal)
        return through - np.cross(own * self.spins[0] + other * self.spins[1], self.normal)


@dataclass
class Memory:
    """What a contact remembers."""

    shear: Array = field(default_factory=lambda: np.zeros(3))
    rolling: Array = field(default_factory=lambda: np.zeros(3))
    twist: Array = field(default_factory=lambda: np.zeros(3))
    angle: float = 0.0
    largest: float = 0.0
    offset: float = 0.0
    last: float = 0.0
    normal: Array | None = None
    spot: float = 0.0


@dataclass(frozen=True)
class Stiffness:
    """Normal force [N], what friction sees of it, its elastic part; tangential stiffness [N/m] and dashpot [kg/s]."""

    force: float
    seen: float
    elastic: float
    shear: float
    dashpot: float


def length(vector: Array) -> float:
    """Length of a vector."""
    return math.sqrt(float(vector @ vector))


def turned(memory: Memory, vector: Array, contact: Contact, dt: float) -> Array:
    """YADE: two small turns, with the old normal."""
    if memory.normal is None:
        return vector
    vector = vector - np.cross(vector, np.cross(memory.normal, contact.normal))
    twist = 0.5 * dt * float(memory.normal @ (contact.spins[0] + contact.spins[1]))
    return vector - np.cross(vector, twist * memory.normal)


def flattened(vector: Array, normal: Array, negligible: float) -> Array:
    """LAMMPS: projected on the contact plane and stretched to the old length, unless it hardly leaves the plane."""
    along = float(vector @ normal)
    if abs(along) <= negligible:
        return vector
    flat = vector - along * normal
    return flat * (length(vector) / length(flat)) if length(flat) > 0 else np.zeros(3)
