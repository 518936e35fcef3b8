from __future__ import annotations

import json
from itertools import combinations, product
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import crossgrain

Array = NDArray[np.float64]
SAMPLES, COUNT, EDGE = 3, 40, 3.0
EVERYTHING = {"kind": "everything"}


class Pack:
    """Random overlapping spheres on a floor, periodic along x and y, with the contacts of an elastic law."""

    def __init__(self) -> None:
        random = np.random.default_rng(4)
        self.radius: Array = random.uniform(0.2, 0.5, COUNT)
        self.position: Array = random.uniform(0.1, EDGE, (SAMPLES, COUNT, 3))
        self.velocity: Array = random.normal(size=(SAMPLES, COUNT, 3))
        self.mass: Array = 2500 * 4 / 3 * np.pi * self.radius**3
        self.start = [0]
        self.pairs: list[tuple[int, int]] = []
        self.forces: list[Array] = []
        self.branches: list[list[tuple[Array, Array]]] = []
        self.body_force: Array = np.zeros((SAMPLES, 1, 3))
        for sample in range(SAMPLES):
            found: list[tuple[Array, Array]] = []
            for i, j in combinations(range(COUNT), 2):
                branch = self.position[sample, i] - self.position[sample, j]
                branch[:2] -= EDGE * np.round(branch[:2] / EDGE)
                overlap = self.radius[i] + self.radius[j] - np.linalg.norm(branch)
                if overlap > 0:
                    force = 100 * overlap * branch / np.linalg.norm(branch)
                    self._add(i, j, force)
                    found.append((force, branch))
            for i in range(COUNT):
                height = self.position[sample, i, 2]
                if height < self.radius[i]:
                    force = np.array([0, 3.0, 100 * (self.radius[i] - height)])
                    self._add(i, COUNT, force)
                    self.body_force[sample, 0] -= force
                    found.append((force, np.array([0, 0, height])))
            self.branches.append(found)
            self.start.append(len(self.pairs))

    def _add(self, first: int, second: int, force: Array) -> None:
        self.pairs.append((first, second))
        self.forces.append(force)

    def context(self) -> dict[str, Any]:
        floor = {"kind": "plane", "point": [0, 0, 0], "normal": [0, 0, 1]}
        return {
            "radius": self.radius.tolist(),
            "mass": self.mass.tolist(),
            "moment_of_inertia": (0.4 * self.mass * self.radius**2).tolist(),
            "gravity": [0, 0, -9.81],
            "domain": {"min": [0, 0, 0], "max": [EDGE, EDGE, 5], "boundary": ["periodic", "periodic", "open"]},
            "bodies": [{"name": "floor", "material": 0, "shape": floor, "motion": {"kind": "fixed"}}],
            "friction": [{"between": [0, 0], "value": 0.5}],
        }

    def columns(self) -> dict[str, Any]:
        return {
            "time": np.arange(SAMPLES),
            "position": self.position,
            "velocity": self.velocity,
            "body_force": self.body_force,
            "contact_start": np.array(self.start),
            "contact_pair": np.array(self.pairs),
            "contact_force": np.array(self.forces),
        }


@pytest.fixture(scope="module")
def pack() -> Pack:
    return Pack()


def measured(pack: Pack, columns: dict[str, Any] | None = None, **measures: dict[str, Any]) -> dict[str, Array]:
    asked = [{"name": name, "measure": measure, "stage": "settle"} for name, measure in measures.items()]
    return crossgrain.measure(json.dumps(asked), json.dumps(pack.context()), columns or pack.columns())


def test_the_binding_gives_what_numpy_counts(pack: Pack) -> None:
    found = measured(
        pack,
        fraction={"kind": "packing_fraction", "region": EVERYTHING, "radii": "present"},
        coordination={"kind": "coordination", "region": EVERYTHING, "bodies": True},
        stress={"kind": "stress_tensor", "region": EVERYTHING, "part": "contacts"},
        share={"kind": "weight_share", "bodies": ["floor"]},
        energy={"kind": "kinetic_energy", "part": "translational"},
        force={"kind": "normal_forces", "statistic": "mean"},
        shear={"kind": "wall_mobilisation", "body": "floor", "direction": [0, 1, 0]},
    )
    volume = EDGE * EDGE * 5
    np.testing.assert_allclose(found["fraction"], (4 / 3 * np.pi * pack.radius**3).sum() / volume, rtol=1e-13)
    assert found["stress"].shape == (SAMPLES, 9)
    for sample in range(SAMPLES):
        rows = slice(pack.start[sample], pack.start[sample + 1])
        pairs, forces = np.array(pack.pairs[rows]), np.array(pack.forces[rows])
        of_particles = pairs[:, 1] < COUNT
        ends = 2 * of_particles.sum() + (~of_particles).sum()
        assert found["coordination"][sample] == ends / COUNT
        stress = sum(np.outer(force, branch) for force, branch in pack.branches[sample]) / volume
        np.testing.assert_allclose(found["stress"][sample].reshape(3, 3), stress, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(found["force"][sample], np.linalg.norm(forces[of_particles], axis=1).mean())
        np.testing.assert_allclose(
            found["shear"][sample], 3 * (~of_particles).sum() / (0.5 * forces[~of_particles, 2].sum())
        )
    np.testing.assert_allclose(found["share"], -pack.body_force[:, 0, 2] / (pack.mass.sum() * 9.81))
    energy = 0.5 * (pack.mass[:, None] * pack.velocity**2).sum(axis=(1, 2))
    np.testing.assert_allclose(found["energy"], energy / (pack.mass * 9.81 * 2 * pack.radius).sum())


def test_a_box_meets_a_count_of_points(pack: Pack) -> None:
    low, high = np.array([-0.4, 0.5, 0.3]), np.array([1.6, 2.5, 2.3])
    region = {"kind": "box", "min": low.tolist(), "max": high.tolist()}
    found = measured(pack, fraction={"kind": "packing_fraction", "region": region, "radii": "present"})["fraction"]
    cells = 50
    points = low + (high - low) * (np.array(list(product(range(cells), repeat=3))) + 0.5) / cells
    inside = np.zeros(len(points))
    for place, radius in zip(pack.position[0], pack.radius, strict=True):
        branch = points - place
        branch[:, :2] -= EDGE * np.round(branch[:, :2] / EDGE)
        inside += (branch**2).sum(axis=1) < radius**2
    # 125,000 points: the surface of the spheres crosses some thousand cells of the grid.
    assert abs(found[0] / inside.mean() - 1) < 2e-3


def test_single_precision_and_strides_are_taken(pack: Pack) -> None:
    whole = {"kind": "coordination", "region": EVERYTHING}
    columns = pack.columns()
    columns["position"] = np.asfortranarray(pack.position.astype(np.float32))
    assert np.array_equal(measured(pack, columns, it=whole)["it"], measured(pack, it=whole)["it"])


def test_units_are_those_of_the_quantity() -> None:
    measures: dict[str, dict[str, Any]] = {
        "number": {"kind": "rattler_share", "region": EVERYTHING, "least_contacts": 4},
        "force": {"kind": "wall_force", "body": "floor", "direction": [0, 0, 1]},
        "stress": {"kind": "stress_tensor", "region": EVERYTHING, "part": "contacts"},
    }
    asked = json.dumps([{"name": name, "measure": measure} for name, measure in measures.items()])
    assert crossgrain.measure_units(asked) == {"number": "-", "force": "N", "stress": "Pa"}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"position": None}, "column position is missing"),
        (
            {"position": np.zeros((SAMPLES, COUNT - 1, 3))},
            r"column position has the shape \[3, 39, 3\], expected \(3, 40",
        ),
        ({"contact_pair": None}, "columns contact_start, contact_pair, contact_force stand together"),
        ({"contact_pair": np.zeros((2, 2))}, "column contact_pair holds values of kind `f`"),
        (
            {"contact_start": None, "contact_pair": None, "contact_force": None},
            "observable it: sample 0: it needs contacts",
        ),
        ({"contact_start": np.array([0, 1, 2, 3])}, "contact_start must have 4 values that rise from 0 to"),
    ],
)
def test_columns_that_do_not_fit_are_refused(pack: Pack, change: dict[str, Any], message: str) -> None:
    columns = {name: value for name, value in (pack.columns() | change).items() if value is not None}
    with pytest.raises(ValueError, match=message):
        measured(pack, columns, it={"kind": "normal_forces", "statistic": "mean"})


def test_unknown_words_are_refused_with_the_known_ones(pack: Pack) -> None:
    with pytest.raises(
        ValueError, match=r"observables: unknown variant `porosity`, expected one of `packing_fraction`"
    ):
        measured(pack, it={"kind": "porosity"})
    context = pack.context() | {"temperature": 300}
    with pytest.raises(ValueError, match=r"context: unknown field `temperature`, expected one of `radius`"):
        crossgrain.measure("[]", json.dumps(context), pack.columns())
    context = pack.context() | {"mass": [1.0]}
    with pytest.raises(ValueError, match="context: mass has 1 values, expected 40 as in radius"):
        crossgrain.measure("[]", json.dumps(context), pack.columns())
