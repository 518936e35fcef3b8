"""Numbers of small networks of contacts against what can be said by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cross_check.sintering.bonds import bond_numbers, fragment_numbers, fragments
from cross_check.sintering.course import reorganisation
from cross_check.sintering.snapshot import Snapshot
from cross_check.sintering.states import (
    Sample,
    densities,
    force_numbers,
    forces,
    friction_numbers,
    overlap_numbers,
    particle_stress,
    relative_overlaps,
    stress_deviator,
    stress_trace,
    wall_effect,
)
from cross_check.sintering.strength import stiffness, strength_numbers

SAMPLE = Sample(cold_stiffness=1e5, friction=0.5, pressure=10.0)
LEFT, BOTTOM, RIGHT, TOP = range(4)


def column(push: float = 3.0, shear: float = 0.0) -> Snapshot:
    """Three disks of 1, 2 and 1 mm in a row between the left and the right wall, each contact pressed by `push` [N]."""
    radius = np.array([1e-3, 2e-3, 1e-3])
    overlap = 1e-4
    x = np.array([0.9e-3, 3.8e-3, 6.7e-3])
    pair = np.array([[1, 0], [2, 1], [0, 3 + LEFT], [2, 3 + RIGHT]])
    normal = np.array([[1.0, 0.0], [1.0, 0.0], [1.0, 0.0], [-1.0, 0.0]])
    across = np.stack([-normal[:, 1], normal[:, 0]], axis=1)
    return Snapshot(
        time=0.0,
        temperature=353.15,
        loading_stiffness=5e4,
        position=np.stack([x, np.full(3, 2e-3)], axis=1),
        radius=radius,
        start_radius=1.01 * radius,
        box=(7.6e-3, 4e-3),
        corner=(0.0, 0.0),
        pair=pair,
        normal=normal,
        overlap=np.full(4, overlap),
        elastic=np.full(4, push),
        limit=np.full(4, 2.0 * abs(shear)),
        force=push * normal + shear * across,
        largest_overlap=np.full(4, 2 * overlap),
    )


def test_both_densities_are_areas_over_that_of_the_box() -> None:
    found = densities(column())
    area = math.pi * 6e-6 / (7.6e-3 * 4e-3)
    assert found["nu_geo"] == pytest.approx(area, rel=1e-14)
    assert found["nu_mat"] == pytest.approx(1.01**2 * area, rel=1e-14)


def test_contacts_are_averaged_apart_for_disks_at_walls() -> None:
    assert wall_effect(column()) == {"C_at_walls": 1.0, "C_inside": 2.0}


def test_overlaps_are_over_the_sum_of_radii_and_small_ones_are_below_a_quarter_of_the_mean() -> None:
    assert relative_overlaps(column()) == pytest.approx([1e-4 / 3e-3] * 2)
    found = overlap_numbers(np.array([0.01, 0.1, 0.1, 0.19]))
    assert found["overlap_mean"] == pytest.approx(0.1)
    assert found["overlap_small_share"] == 0.25
    assert found["overlap_std"] == pytest.approx(math.sqrt(2 * 0.09**2 / 4))


def test_forces_are_in_units_of_twice_the_mean_radius_times_the_pressure() -> None:
    assert forces(column(push=-0.02), SAMPLE) == pytest.approx([-1.0, -1.0])
    found = force_numbers(np.array([-1.0, -3.0, 4.0, 4.0, 0.0]))
    assert found["f_negative_share"] == 0.4
    assert found["f_pull_over_push"] == 0.5
    assert (found["f_min"], found["f_max"], found["f_mean"]) == (-3.0, 4.0, pytest.approx(0.8))
    assert math.isnan(force_numbers(np.array([1.0]))["f_pull_over_push"])


def test_friction_in_use_is_force_over_limit_times_hot_friction() -> None:
    found = friction_numbers(column(shear=0.5), SAMPLE)
    assert found["mu_t_largest_share"] == pytest.approx(0.5)
    assert found["mu_t_mean"] == pytest.approx(0.5 * 0.25)  # half of the limit, half of the cold friction of 0.5
    assert found["ft_mean"] == pytest.approx(0.5 / 0.02)
    assert found["frictional_share"] == 0.0
    assert friction_numbers(column(shear=0.0), SAMPLE)["mu_t_largest_share"] == 0.0
    turned = np.array([math.cos(0.3), math.sin(0.3)])
    rounded = replace(column(), normal=np.tile(turned, (4, 1)), force=3.0 * np.tile(turned * (1 + 1e-16), (4, 1)))
    assert friction_numbers(rounded, SAMPLE)["mu_t_largest_share"] == 0.0
    forbidden = replace(column(shear=0.5), limit=np.zeros(4))
    assert friction_numbers(forbidden, SAMPLE)["mu_t_largest_share"] == math.inf


def test_the_stress_of_a_squeezed_disk_is_that_of_the_closed_form() -> None:
    stress = particle_stress(column(push=3.0))
    expected = 2 * np.array([1e-3, 2e-3, 1e-3]) * 3.0 / (np.pi * np.array([1e-6, 4e-6, 1e-6]))
    assert stress[:, 0, 0] == pytest.approx(expected)  # compression is positive
    assert np.abs(stress[:, 1, 1]).max() == 0.0
    assert stress_trace(column(push=3.0)) == pytest.approx(expected / 2)
    assert stress_deviator(column(push=3.0)) == pytest.approx(expected / 2)
    assert stress_trace(column(push=-3.0)) == pytest.approx(-expected / 2)


def test_fragments_are_what_contacts_hold_together() -> None:
    assert fragments(6, np.array([[0, 1], [1, 2], [4, 5]])).tolist() == [3, 2, 1]
    assert fragments(3, np.zeros((0, 2), dtype=np.int64)).tolist() == [1, 1, 1]
    found = fragment_numbers(column())
    assert found == {"largest_share": 1.0, "single_share": 0.0, "fragments": 1.0}


def test_a_bond_survives_while_its_largest_overlap_is_half_of_what_it_was() -> None:
    before = column()
    swapped = replace(before, pair=np.array([[0, 1], [2, 1], [0, 3], [2, 5]]))
    assert bond_numbers(before, swapped)["bonds_surviving"] == 1.0
    shrunk = replace(before, largest_overlap=np.array([1e-4, 0.99e-4, 1e-4, 1e-4]))
    found = bond_numbers(before, shrunk)
    assert found["bonds_surviving"] == 0.5
    assert found["bond_clusters"] == 1.0
    assert found["bond_largest_share"] == pytest.approx(2 / 3)
    assert found["bond_single_share"] == pytest.approx(1 / 3)
    gone = replace(before, pair=before.pair[2:], **{
        name: getattr(before, name)[2:]
        for name in ("normal", "overlap", "elastic", "limit", "force", "largest_overlap")
    })  # fmt: skip
    assert bond_numbers(before, gone)["bonds_surviving"] == 0.0


def test_stiffness_failure_and_dilatancy_of_a_test_with_straight_lines() -> None:
    strain = np.linspace(0.0, 0.1, 101)
    stress = np.where(strain <= 0.03, 10.0 + 5e4 * strain, 1510.0 - 2e4 * (strain - 0.03))
    density = np.where(strain <= 0.02, 0.9 + strain, 0.92 - 2 * (strain - 0.02))
    found = strength_numbers(strain, stress, density, pressure=10.0)
    assert found["failure_stress"] == pytest.approx(1510.0)
    assert found["failure_strain"] == pytest.approx(0.03)
    assert found["stiffness"] == pytest.approx(5e4)
    assert found["nu_gain"] == pytest.approx(0.02)
    assert found["nu_drop"] == pytest.approx(0.16)


def test_stiffness_is_that_of_the_first_rise_between_a_tenth_and_a_half() -> None:
    strain = np.linspace(0.0, 0.1, 201)
    rise = np.interp(strain, [0.0, 0.01, 0.03, 0.1], [0.0, 100.0, 500.0, 1000.0])
    assert stiffness(strain, rise, 0.0) == pytest.approx(2e4)
    assert math.isnan(stiffness(strain[:4], np.array([0.0, 0.0, 1.0, 0.0]), 0.0))


def hot(coordination: list[float], density: list[float]) -> dict[str, float]:
    time = 5e-3 * np.arange(len(density), dtype=np.float64)
    stress = np.resize(np.array([1.01, 0.99]), len(time))
    stress[2:10] = np.resize(np.array([1.3, 0.7]), len(stress[2:10]))
    return reorganisation(time, np.asarray(density), np.asarray(coordination), stress)


def test_a_fall_of_coordination_counts_over_20_ms_with_rising_density() -> None:
    rising = np.linspace(0.8, 0.9, 12).tolist()
    found = hot([4.0] * 6 + [3.97] * 6, rising)
    assert found["C_largest_drop"] == pytest.approx(-0.03)
    assert found["C_drop_windows"] == 4.0
    assert found["stress_std_ratio"] == pytest.approx(30.0)
    assert found["nu_smallest_rise"] > 0.0
    short = hot([4.0] * 6 + [3.97] * 3 + [4.0] * 3, rising)
    assert short["C_drop_windows"] == 3.0
    assert hot([4.0] * 6 + [3.97] * 6, rising[::-1])["C_largest_drop"] == math.inf
    assert hot([4.0] * 12, rising)["C_drop_windows"] == 0.0


@pytest.mark.parametrize("contacts", range(600, 700))
def test_three_contacts_of_300_disks_are_a_fall_of_a_fiftieth(contacts: int) -> None:
    found = hot([2 * contacts / 300] * 6 + [2 * (contacts - 3) / 300] * 6, np.linspace(0.8, 0.9, 12).tolist())
    assert found["C_largest_drop"] == -0.02
    assert found["C_drop_windows"] == 4.0


def test_a_density_that_falls_from_10_ms_to_10_ms_is_seen() -> None:
    density = [0.8, 0.81, 0.82, 0.83, 0.825, 0.82, 0.83, 0.84]
    assert hot([4.0] * 8, density)["nu_smallest_rise"] == pytest.approx(0.005)
    density[6] = 0.82
    assert hot([4.0] * 8, density)["nu_smallest_rise"] == pytest.approx(-0.005)
