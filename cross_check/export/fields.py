"""VTU: fields of particles, one file for each sample, and walls as VTU and STL, all through meshio."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from cross_check import meshes
from cross_check.export.trajectory import Trajectory
from cross_check.export.vtp import collection
from cross_check.export.walls import wall_triangles
from cross_check.meshes import Mesh


def write(trajectory: Trajectory, folder: Path) -> list[Path]:
    """Writes `particles.pvd` over VTU files and, where the case is known, `walls.vtu` and `walls.stl` at the start."""
    written = collection(
        trajectory, folder, "particles", ".vtu", lambda path, sample: _particles(trajectory, path, sample)
    )
    if trajectory.scene is not None and trajectory.scene.bodies:
        points, triangles, bodies = wall_triangles(trajectory)
        if len(triangles) == 0:
            return written
        surface = Mesh(points, [("triangle", triangles)])
        meshes.write(folder / "walls.stl", surface)
        meshes.write(folder / "walls.vtu", Mesh(points, surface.cells, cell_data={"body": [bodies]}))
        written += [folder / "walls.vtu", folder / "walls.stl"]
    return written


def _particles(trajectory: Trajectory, path: Path, sample: int) -> None:
    data = {"id": np.arange(trajectory.count)}
    data |= {field.name: np.array(field.values[sample]) for field in trajectory.fields()}
    meshes.write(path, Mesh(trajectory.record["position"][sample], point_data=data))
