"""Numbers of one state of a sample: densities, contacts, overlaps, forces, friction, stress of particles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cross_check.record import Array
from cross_check.sintering.outcome import Numbers
from cross_check.sintering.snapshot import Indices, Snapshot

# Mean radius a0 of the samples at the melting temperature [m]; forces are given in units of 2 a0 p.
MEAN_RADIUS = 1e-3
SMALL = 0.25  # of the mean overlap: below it an overlap counts as small
MOBILISED = 0.5  # of the limit of friction: above it a contact counts as frictional


@dataclass(frozen=True)
class Sample:
    """What the law and the test of a sample say: k1 of the cold [N/m], friction of the cold [-], pressure [N/m]."""

    cold_stiffness: float
    friction: float
    pressure: float

    @property
    def force(self) -> float:
        """The unit of forces, 2 a0 p [N]."""
        return 2.0 * MEAN_RADIUS * self.pressure


def state_numbers(state: Snapshot, sample: Sample) -> Numbers:
    """All numbers of one state by name; those that are not defined are NaN (docs/sintering.md)."""
    return {
        "temperature": state.temperature,
        "k1_ratio": state.loading_stiffness / sample.cold_stiffness,
        **densities(state),
        **wall_effect(state),
        **overlap_numbers(relative_overlaps(state)),
        **force_numbers(forces(state, sample)),
        **friction_numbers(state, sample),
        **stress_numbers(state),
    }


def densities(state: Snapshot) -> Numbers:
    """Area of the disks over that of the box: with present radii, and with those of the start (the material's)."""
    area = state.box[0] * state.box[1]
    present, material = np.pi * np.sum(state.radius**2), np.pi * np.sum(state.start_radius**2)
    return {"nu_geo": float(present / area), "nu_mat": float(material / area)}


def wall_effect(state: Snapshot) -> Numbers:
    """Mean number of contacts with other particles of those particles that touch a wall, and of the rest."""
    both = state.between_particles
    contacts = np.bincount(state.pair[both].ravel(), minlength=state.count).astype(np.int64)
    at_wall = np.zeros(state.count, dtype=bool)
    at_wall[state.pair[~both, 0]] = True
    return {"C_at_walls": _mean(contacts[at_wall]), "C_inside": _mean(contacts[~at_wall])}


def relative_overlaps(state: Snapshot) -> Array:
    """Overlaps of pairs of particles over the sums of their radii [-]."""
    both = state.between_particles
    first, second = state.pair[both][:, 0], state.pair[both][:, 1]
    return state.overlap[both] / (state.radius[first] + state.radius[second])


def overlap_numbers(overlaps: Array) -> Numbers:
    """Mean, standard deviation, and the share below a quarter of the mean."""
    mean = _mean(overlaps)
    return {
        "overlap_mean": mean,
        "overlap_std": _std(overlaps),
        "overlap_small_share": _mean(overlaps < SMALL * mean),
    }


def forces(state: Snapshot, sample: Sample) -> Array:
    """Elastic normal forces of pairs of particles in units of 2 a0 p, positive where they repel [-]."""
    return state.elastic[state.between_particles] / sample.force


def force_numbers(found: Array) -> Numbers:
    """Moments and extremes of the normal forces, the share that attracts, and mean attraction over mean repulsion."""
    pull, push = found[found < 0.0], found[found > 0.0]
    return {
        "f_mean": _mean(found),
        "f_std": _std(found),
        "f_min": float(np.min(found)) if len(found) else np.nan,
        "f_max": float(np.max(found)) if len(found) else np.nan,
        "f_negative_share": _mean(found < 0.0),
        "f_pull_over_push": _mean(-pull) / _mean(push) if len(pull) and len(push) else np.nan,
    }


def friction_numbers(state: Snapshot, sample: Sample) -> Numbers:
    """Tangential forces of pairs: their mean, the friction mu_t that they use, and how near that is to the limit.

    mu_t = f_t/(f_n - f_min) and the limit is mu(T,t) (f_n - f_min), so that mu_t/mu(T,t) is force over limit.
    """
    both = state.between_particles
    size, limit = state.friction_force[both], state.limit[both]
    used = np.divide(size, limit, out=np.where(size > 0.0, np.inf, 0.0), where=limit > 0.0)
    hot_friction = sample.friction * state.loading_stiffness / sample.cold_stiffness
    return {
        "ft_mean": _mean(size) / sample.force,
        "mu_t_mean": _mean(used) * hot_friction,
        "mu_t_largest_share": float(np.max(used)) if len(used) else np.nan,
        "frictional_share": _mean(used > MOBILISED),
    }


def particle_stress(state: Snapshot) -> Array:
    """Stress of each particle, shape (N, 2, 2) [N/m], compression positive.

    (1/V) sum over its contacts of l f, with V = pi a^2, f the force on the particle and l the vector from the contact
    to the centre: the sign is turned against that of a vector from the centre to the contact.
    """
    stress = np.zeros((state.count, 2, 2))
    first, second = state.pair[:, 0], state.pair[:, 1]
    both = state.between_particles
    arm = state.radius[first][:, None] * state.normal
    np.add.at(stress, first, np.einsum("md,me->mde", arm, state.force))
    arm = -state.radius[second[both]][:, None] * state.normal[both]
    np.add.at(stress, second[both], np.einsum("md,me->mde", arm, -state.force[both]))
    return stress / (np.pi * state.radius**2)[:, None, None]


def stress_trace(state: Snapshot) -> Array:
    """Half the trace of the stress of each particle, shape (N,) [N/m]: the mean of its principal stresses."""
    return 0.5 * np.trace(particle_stress(state), axis1=1, axis2=2)


def stress_deviator(state: Snapshot) -> Array:
    """Half the difference of the principal stresses of each particle, of the symmetric part, shape (N,) [N/m]."""
    stress = particle_stress(state)
    shear = 0.5 * (stress[:, 0, 1] + stress[:, 1, 0])
    return np.hypot(0.5 * (stress[:, 0, 0] - stress[:, 1, 1]), shear)


def stress_numbers(state: Snapshot) -> Numbers:
    """Means over the particles of the mean principal stress and of the deviator [N/m]."""
    return {"stress_trace_mean": _mean(stress_trace(state)), "stress_deviator_mean": _mean(stress_deviator(state))}


def _mean(values: Array | Indices | NDArray[np.bool_]) -> float:
    return float(np.mean(values)) if len(values) else np.nan


def _std(values: Array) -> float:
    return float(np.std(values)) if len(values) else np.nan
