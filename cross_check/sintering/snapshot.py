"""One sample of a record of disks between four walls, in the plane of motion: x to the right, z up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cross_check.record import Array, RecordError, RunRecord

Indices = NDArray[np.int64]

WALLS = ("left", "bottom", "right", "top")
NEEDED = ("temperature", "radius", "body_point", "law_state", "contact_elastic", "contact_limit", "contact_memory")

# Share of the normal force below which a tangential one is rounding of the normal [-].
ROUNDING = 1e-12


@dataclass(frozen=True)
class Snapshot:
    """State of N disks with M contacts at one time.

    `position` (N, 2) [m]; `radius` (N,) at the present temperature and `start_radius` (N,) at that of the start [m];
    `box` the inner width and height [m]; `corner` the lower left one [m]; `pair` (M, 2): a particle, and another one or
    N + a wall; `normal` (M, 2) from the second to the first [-]; `overlap` (M,) [m]; `elastic` (M,) [N], positive where
    it repels; `limit` (M,), the largest friction [N]; `force` (M, 2) on the first [N]; `largest_overlap` (M,) [m].
    `loading_stiffness` is k1(T, t) [N/m], `temperature` that of the particles [K].
    """

    time: float
    temperature: float
    loading_stiffness: float
    position: Array
    radius: Array
    start_radius: Array
    box: tuple[float, float]
    corner: tuple[float, float]
    pair: Indices
    normal: Array
    overlap: Array
    elastic: Array
    limit: Array
    force: Array
    largest_overlap: Array

    @property
    def count(self) -> int:
        """Number of particles."""
        return len(self.radius)

    @property
    def between_particles(self) -> NDArray[np.bool_]:
        """Which contacts are of two particles, shape (M,)."""
        return self.pair[:, 1] < self.count

    @property
    def friction_force(self) -> Array:
        """Size of the tangential force of each contact, shape (M,) [N]; what is rounding of the normal one is none."""
        along = np.einsum("md,md->m", self.force, self.normal)
        size = np.linalg.norm(self.force - along[:, None] * self.normal, axis=1)
        return np.where(size > ROUNDING * np.abs(along), size, 0.0)


def check(record: RunRecord, where: str) -> None:
    """Raises RecordError unless the record holds what a snapshot needs."""
    for name in ("contact_start", *NEEDED):
        if name not in record.columns:
            raise RecordError(f"{where}: column {name} is missing, the sintering study needs it")
    missing = [name for name in WALLS if name not in record.header.bodies]
    if missing:
        known = ", ".join(record.header.bodies)
        raise RecordError(f"{where}: there is no body {', '.join(missing)} (bodies: {known})")


def inner_box(record: RunRecord) -> tuple[Array, Array]:
    """Inner width and height of the box at all samples, shapes (T,) [m]."""
    point = record["body_point"]
    left, bottom, right, top = (record.header.bodies.index(name) for name in WALLS)
    return point[:, right, 0] - point[:, left, 0], point[:, top, 2] - point[:, bottom, 2]


def snapshot(record: RunRecord, index: int) -> Snapshot:
    """The sample `index` of a record that was checked; negative ones count from the end."""
    index = range(len(record.step))[index]
    columns = record.columns
    rows = slice(int(columns["contact_start"][index]), int(columns["contact_start"][index + 1]))
    position, radius = columns["position"][index][:, [0, 2]], columns["radius"][index]
    point = columns["body_point"][index]
    left, bottom, right, top = (record.header.bodies.index(name) for name in WALLS)
    pair = columns["contact_pair"][rows].astype(np.int64)
    normal, distance = _normals(pair, position, point, record.header.bodies)
    second = np.minimum(pair[:, 1], len(radius) - 1)
    reach = radius[pair[:, 0]] + np.where(pair[:, 1] < len(radius), radius[second], 0.0)
    return Snapshot(
        time=float(columns["time"][index]),
        temperature=float(columns["temperature"][index]),
        loading_stiffness=float(columns["law_state"][index, 0]),
        position=position,
        radius=radius,
        start_radius=np.asarray(record.header.radius, dtype=np.float64),
        box=(float(point[right, 0] - point[left, 0]), float(point[top, 2] - point[bottom, 2])),
        corner=(float(point[left, 0]), float(point[bottom, 2])),
        pair=pair,
        normal=normal,
        overlap=reach - distance,
        elastic=columns["contact_elastic"][rows],
        limit=columns["contact_limit"][rows],
        force=columns["contact_force"][rows][:, [0, 2]],
        largest_overlap=columns["contact_memory"][rows][:, 0],
    )


def _normals(pair: Indices, position: Array, point: Array, bodies: list[str]) -> tuple[Array, Array]:
    """Unit normals from the second to the first, shape (M, 2), and distances of centres or to the wall, shape (M,)."""
    count = len(position)
    normal, distance = np.zeros((len(pair), 2)), np.zeros(len(pair))
    both = pair[:, 1] < count
    apart = position[pair[both, 0]] - position[pair[both, 1]]
    distance[both] = np.linalg.norm(apart, axis=1)
    normal[both] = apart / distance[both, None]
    inward = {"left": (1.0, 0.0), "right": (-1.0, 0.0), "bottom": (0.0, 1.0), "top": (0.0, -1.0)}
    for name in WALLS:
        body = bodies.index(name)
        mine = pair[:, 1] == count + body
        normal[mine] = inward[name]
        distance[mine] = (position[pair[mine, 0]] - point[body][[0, 2]]) @ np.array(inward[name])
    return normal, distance
