"""What a record holds, made ready for files: fields of particles, contacts as lines, series."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cross_check.engine import Case
from cross_check.geometry import facing, nearest
from cross_check.record import UNITS, Array, Header, RunRecord
from cross_check.scene import Scene, Shape

Index = NDArray[np.int64]

CONTACT_COLUMNS = ("contact_start", "contact_pair", "contact_force")
PLAIN = ("step", "time", "position")
# Shared by all contacts: neither of particles nor of bodies.
LAW_STATE = "law_state"
#: A contact longer than this multiple of the sum of the radii is one across a periodic face [-].
LONGEST_CONTACT = 2.0


class ExportError(Exception):
    """What cannot be written as asked: the message names the file or key, the value and what is allowed."""


@dataclass(frozen=True)
class Field:
    """A column of a record that has one value for each particle: `values` is (T, N) or (T, N, 3) in `unit`."""

    name: str
    unit: str
    values: NDArray[Any]


@dataclass(frozen=True)
class Series:
    """A column that has one value for each sample: `values` is (T,) in `unit`."""

    name: str
    unit: str
    values: Array


@dataclass(frozen=True)
class Contacts:
    """The K contacts of one sample.

    `first` and `second` (K,) are particles, counted from 0; `second` is -1 where the contact is with `body` (K,), which
    is -1 elsewhere. Lines run from `start` to `end` (K, 3) [m]; `force` (K, 3) [N] acts on the first particle. Its part
    along the normal, `normal_force` (K,) [N], is positive where it presses. That and `tangential_force` (K,) [N] are
    NaN where the normal is not known, because the record does not tell the shape of the body.
    """

    first: Index
    second: Index
    body: Index
    start: Array
    end: Array
    force: Array
    normal_force: Array
    tangential_force: Array

    def __len__(self) -> int:
        return len(self.first)

    def only(self, chosen: NDArray[np.bool_]) -> Contacts:
        """The contacts where `chosen` (K,) holds."""
        parts = {name: getattr(self, name)[chosen] for name in self.__dataclass_fields__}
        return Contacts(**parts)


@dataclass(frozen=True)
class Trajectory:
    """A record and, where the case is known, its scene, which tells materials, domain and shapes of bodies."""

    record: RunRecord
    scene: Scene | None = None

    def __post_init__(self) -> None:
        present = [name for name in CONTACT_COLUMNS if name in self.record.columns]
        missing = [name for name in CONTACT_COLUMNS if name not in self.record.columns]
        if present and missing:
            raise ExportError(f"{self.name}: column {present[0]} stands without {', '.join(missing)}")
        if present:
            _check_contacts(self)

    @property
    def header(self) -> Header:
        """The header of the record."""
        return self.record.header

    @property
    def name(self) -> str:
        """`case/variant/seed=1 by source`, for messages."""
        seed = "" if self.header.seed is None else f"seed={self.header.seed}"
        parts = (self.header.case, self.header.variant, seed)
        return f"{'/'.join(part for part in parts if part)} by {self.header.source}"

    @property
    def samples(self) -> int:
        """Number of samples T [-]."""
        return len(self.record.step)

    @property
    def count(self) -> int:
        """Number of particles N [-]."""
        return len(self.header.mass)

    @property
    def has_contacts(self) -> bool:
        """Whether the record tells contacts."""
        return CONTACT_COLUMNS[0] in self.record.columns

    def fields(self) -> list[Field]:
        """Every field of the particles but the position, the radius and the mass first, in the order of the record."""
        found = [
            Field(name, unit, np.broadcast_to(np.asarray(values), (self.samples, self.count)))
            for name, unit, values in (("radius", "m", self.header.radius), ("mass", "kg", self.header.mass))
            if name not in self.record.columns
        ]
        if self.scene is not None:
            materials = np.array([particle.material for particle in self.scene.particles])
            found.append(Field("material", "-", np.broadcast_to(materials, (self.samples, self.count))))
        shapes = ((self.samples, self.count), (self.samples, self.count, 3))
        for name, column in self.record.columns.items():
            if name in (*PLAIN, LAW_STATE) or name.startswith(("body_", "energy_", "contact_")):
                continue
            if column.shape in shapes:
                found.append(Field(name, UNITS.get(name, "-"), column))
        return found

    def radius(self, sample: int) -> Array:
        """Radii of the particles [m], shape (N,)."""
        return next(field.values[sample] for field in self.fields() if field.name == "radius")

    def series(self) -> list[Series]:
        """Energies, the state of the law, and forces on bodies and their points, one series for each component."""
        found: list[Series] = []
        for name, column in self.record.columns.items():
            unit = UNITS.get(name, "-")
            if name in PLAIN or name.startswith("contact_"):
                continue
            if column.ndim == 1:
                found.append(Series(name, unit, column))
            elif name == LAW_STATE:
                states = enumerate(self.header.law_state)
                found += [Series(state, own, column[:, place]) for place, (state, own) in states]
            elif name.startswith("body_"):
                for number, body in enumerate(self.header.bodies):
                    values: Array = np.reshape(column[:, number], (self.samples, -1))
                    suffixes = ("_x", "_y", "_z") if values.shape[1] == 3 else ("",)
                    found += [
                        Series(f"{name}{suffix} {body}", unit, values[:, place])
                        for place, suffix in enumerate(suffixes)
                    ]
        return found

    @cached_property
    def box(self) -> tuple[Array, Array, tuple[str, str, str]]:
        """Corners [m], shape (3,) each, and the boundary of every axis: the domain, or what holds all particles."""
        if self.scene is not None:
            domain = self.scene.domain
            return np.array(domain.min), np.array(domain.max), domain.boundary
        position = self.record["position"]
        reach = np.stack([self.radius(sample) for sample in range(self.samples)])[:, :, None]
        low, high = (position - reach).min(axis=(0, 1)), (position + reach).max(axis=(0, 1))
        return low, high, ("open", "open", "open")

    def shape_at(self, body: int, sample: int) -> Shape | None:
        """The shape of a body at a sample, or None where the record and the case do not tell where it is."""
        if self.scene is None:
            return None
        if "body_point" in self.record.columns:
            x, y, z = self.record["body_point"][sample, body].tolist()
            return replace(self.scene.bodies[body].shape, point=(x, y, z))
        return moved(self.scene, body, int(self.record.step[sample]))

    def contacts(self, sample: int) -> Contacts:
        """The contacts of a sample. Raises ExportError where there are none to be had."""
        if not self.has_contacts:
            raise ExportError(f"{self.name}: the record holds no contacts (column {CONTACT_COLUMNS[0]} is missing)")
        start = self.record.columns["contact_start"]
        rows = slice(int(start[sample]), int(start[sample + 1]))
        pair = self.record.columns["contact_pair"][rows].astype(np.int64)
        force = self.record["contact_force"][rows]
        first, other = pair[:, 0], pair[:, 1]
        at_body = other >= self.count
        begin = self.record["position"][sample][first]
        end, normal = np.empty_like(begin), np.full_like(begin, np.nan)
        end[~at_body], normal[~at_body] = self._pair_lines(sample, first[~at_body], other[~at_body])
        for body in np.unique(other[at_body]) - self.count:
            chosen = other == body + self.count
            end[chosen], normal[chosen] = self._body_lines(sample, int(body), first[chosen], force[chosen])
        pressing = np.einsum("ij,ij->i", force, normal)
        tangential = np.linalg.norm(force - pressing[:, None] * normal, axis=1)
        second, bodies = np.where(at_body, -1, other), np.where(at_body, other - self.count, -1)
        return Contacts(first, second, bodies, begin, end, force, pressing, tangential)

    def _pair_lines(self, sample: int, first: Index, second: Index) -> tuple[Array, Array]:
        """Ends of the lines [m] and unit normals towards the first particles of contacts of two particles."""
        position, radius = self.record["position"][sample], self.radius(sample)
        branch = position[second] - position[first]
        if self.scene is not None:
            branch = nearest(self.scene.domain, branch)
        length = np.linalg.norm(branch, axis=1)
        wrong = np.flatnonzero((length > LONGEST_CONTACT * (radius[first] + radius[second])) | (length == 0))
        if wrong.size:
            a, b = int(first[wrong[0]]), int(second[wrong[0]])
            advice = (
                "" if self.scene is not None else "; of a periodic box, give the case (--case), which tells its size"
            )
            where = f"{self.name}: contact of particles {a} and {b} at step {int(self.record.step[sample])}"
            raise ExportError(f"{where}: the centres are {length[wrong[0]]:.3g} m apart{advice}")
        return position[first] + branch, -branch / length[:, None]

    def _body_lines(self, sample: int, body: int, first: Index, force: Array) -> tuple[Array, Array]:
        """The same of contacts with a body; where its shape is not known, the surface point against the force."""
        centers = self.record["position"][sample][first]
        shape = self.shape_at(body, sample)
        if shape is not None:
            normal, distance = facing(shape, centers)
            return centers - distance[:, None] * normal, normal
        size = np.linalg.norm(force, axis=1, keepdims=True)
        along = np.divide(force, size, out=np.zeros_like(force), where=size > 0)
        return centers - self.radius(sample)[first][:, None] * along, np.full_like(force, np.nan)


def moved(scene: Scene, body: int, step: int) -> Shape | None:
    """The shape of a body at a step, through the stages of the scene, or None where the scene does not say."""
    name = scene.bodies[body].name
    kinds = {kind for moving, kind in scene.motions() if moving == name}
    if scene.start is not None or not kinds <= {"fixed", "prescribed"}:
        return None
    shape, begin = scene.bodies[body].shape, 0
    point = np.array(shape.point)
    for index, length in enumerate([stage.steps for stage in scene.stages] or [scene.steps]):
        motion = scene.at_stage(index).bodies[body].motion
        lasted = min(step - begin, length) * scene.time_step
        point = point + lasted * np.array(motion.velocity or (0.0, 0.0, 0.0))
        begin += length
        if begin >= step:
            break
    x, y, z = point.tolist()
    return replace(shape, point=(x, y, z))


def scene_of(header: Header, case: Case) -> Scene:
    """The scene of a case that a record is a record of. Raises ExportError where there is none."""
    if header.case != case.name:
        raise ExportError(f"{case.path}: holds the case {case.name}, the record is one of {header.case}")
    scenes = [scene for variant in case.variants for scene in variant.scenes]
    wanted = (header.variant, header.seed, header.refinement)
    scene = next((item for item in scenes if (item.variant, item.seed, item.refinement) == wanted), None)
    if scene is None:
        known = ", ".join(dict.fromkeys(item.member or "(unnamed)" for item in scenes))
        variant, seed, refinement = wanted
        raise ExportError(
            f"{case.path}: has no scene of variant {variant!r}, seed {seed}, refinement {refinement} (known: {known})"
        )
    if len(scene.particles) != len(header.mass) or [body.name for body in scene.bodies] != header.bodies:
        raise ExportError(f"{case.path}: states other particles or bodies than the record of {header.case} holds")
    return scene


def _check_contacts(trajectory: Trajectory) -> None:
    """Raises ExportError unless the ragged columns of contacts fit one another and the header."""
    start, pair, force = (trajectory.record.columns[name] for name in CONTACT_COLUMNS)
    where, count = trajectory.name, trajectory.count
    if start.shape != (trajectory.samples + 1,) or start[0] != 0 or np.any(np.diff(start) < 0):
        raise ExportError(f"{where}: contact_start must hold {trajectory.samples + 1} numbers that grow from 0")
    total = int(start[-1])
    if pair.shape != (total, 2) or force.shape != (total, 3):
        raise ExportError(
            f"{where}: contact_start counts {total} contacts, contact_pair has shape {pair.shape} and contact_force"
            f" {force.shape}"
        )
    highest = count + len(trajectory.header.bodies)
    wrong = (pair[:, 0] < 0) | (pair[:, 0] >= count) | (pair[:, 1] < 0) | (pair[:, 1] >= highest)
    wrong |= pair[:, 0] == pair[:, 1]
    if np.any(wrong):
        row = int(np.argmax(wrong))
        raise ExportError(
            f"{where}: contact_pair[{row}] = {pair[row].tolist()}: two different numbers, the first below {count}"
            f" (particles), the second below {highest} (particles, then bodies)"
        )
    if not np.all(np.isfinite(force)):
        raise ExportError(
            f"{where}: contact_force is not a finite number in row {np.argwhere(~np.isfinite(force))[0][0]}"
        )
