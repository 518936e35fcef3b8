"""Meshes through meshio: what is written reads back to the same bits, and everything else is refused."""

from __future__ import annotations

# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# VTK and the shapes of arrays are not typed.
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_bed import Bed

from cross_check import export, meshes
from cross_check.export.trajectory import Trajectory
from cross_check.export.walls import FACES, triangulate, wall_triangles
from cross_check.meshes import FORMATS, Mesh, MeshError
from cross_check.record import read as read_record
from cross_check.scene import Cylinder, Domain, Plane

BOX = Domain((-1.0, -2.0, 0.0), (1.0, 2.0, 3.0), ("open", "open", "open"))


def surface() -> Mesh:
    points = np.random.default_rng(3).normal(size=(12, 3)) * np.pi * 1e-3
    return Mesh(points, [("triangle", np.arange(12).reshape(4, 3))])


def areas(points: Any, triangles: Any) -> Any:
    """Areas times unit normals, (F, 3)."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    return 0.5 * np.cross(b - a, c - a)


@pytest.mark.parametrize("suffix", list(FORMATS))
def test_triangles_come_back_bit_for_bit(tmp_path: Path, suffix: str) -> None:
    if suffix == ".xdmf":
        pytest.importorskip("h5py", reason="h5py, which meshio needs for XDMF, is not installed")
    mesh, path = surface(), tmp_path / f"surface{suffix}"
    meshes.write(path, mesh)
    assert np.array_equal(meshes.read(path).corners("triangle"), mesh.corners("triangle"))


@pytest.mark.parametrize("suffix", [suffix for suffix, form in FORMATS.items() if form.data])
def test_points_get_vertex_cells_and_keep_their_values(tmp_path: Path, suffix: str) -> None:
    if suffix == ".xdmf":
        pytest.importorskip("h5py", reason="h5py, which meshio needs for XDMF, is not installed")
    points = surface().points
    data = {"velocity": points * 7, "id": np.arange(12), "unknown": np.full(12, np.nan)}
    meshes.write(tmp_path / f"points{suffix}", Mesh(points, point_data=data))
    back = meshes.read(tmp_path / f"points{suffix}")
    assert [kind for kind, _ in back.cells] == ["vertex"]
    assert np.array_equal(back.points, points)
    for name, values in data.items():
        assert np.array_equal(back.point_data[name], values, equal_nan=name == "unknown")


@pytest.mark.parametrize(
    ("name", "mesh", "words"),
    [
        ("a.msh", surface(), r"no such mesh format '.msh' \(known: .vtu, .vtk"),
        ("a.stl", Mesh(surface().points), "holds no cells of kind vertex"),
        ("a.off", replace(surface(), point_data={"v": surface().points}), "holds no values at points"),
        ("a.obj", Mesh(surface().points, [("line", np.array([[0, 1]]))]), "holds no cells of kind line"),
    ],
)
def test_what_a_format_cannot_hold_is_refused(tmp_path: Path, name: str, mesh: Mesh, words: str) -> None:
    with pytest.raises(MeshError, match=words):
        meshes.write(tmp_path / name, mesh)
    assert not (tmp_path / name).exists()


def test_a_file_that_does_not_read_back_is_an_error_and_is_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = FORMATS[".stl"]
    monkeypatch.setitem(FORMATS, ".stl", replace(kept, options={"binary": True}))  # binary STL is single precision
    with pytest.raises(MeshError, match="cells of kind triangle do not read back"):
        meshes.write(tmp_path / "surface.stl", surface())
    assert not (tmp_path / "surface.stl").exists()


@pytest.mark.parametrize("suffix", [".vtu", ".vtk", ".stl", ".ply", ".obj"])
def test_a_file_that_is_no_mesh_is_an_error_and_not_the_end(
    tmp_path: Path, suffix: str, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"broken{suffix}"
    path.write_bytes(b"no mesh at all \x00\x01" * 20)
    with pytest.raises(MeshError, match=str(path)):
        meshes.read(path)
    assert capfd.readouterr() == ("", "")


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"gone\.vtu: no such file"):
        meshes.read(tmp_path / "gone.vtu")


def test_a_plane_in_a_face_of_the_domain_is_that_face() -> None:
    points, triangles = triangulate(Plane((0.3, 0.1, 0.0), (0.0, 0.0, 1.0)), BOX)
    assert sorted(map(tuple, points.tolist())) == [(-1, -2, 0), (-1, 2, 0), (1, -2, 0), (1, 2, 0)]
    assert np.array_equal(areas(points, triangles).sum(axis=0), (0, 0, 8))


def test_an_oblique_plane_is_a_hexagon_that_faces_the_particles() -> None:
    cube = Domain((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), ("open", "open", "open"))
    normal = (1 / np.sqrt(3),) * 3
    points, triangles = triangulate(Plane((0.0, 0.0, 0.0), normal), cube)
    assert len(points) == 6
    # The section of a cube of edge 2 through its middle across the diagonal: a regular hexagon of side sqrt 2.
    assert np.allclose(areas(points, triangles).sum(axis=0), 3 * np.sqrt(3) * np.array(normal), rtol=1e-12)


def test_a_plane_beside_the_domain_has_no_triangles() -> None:
    points, triangles = triangulate(Plane((0.0, 0.0, -0.1), (0.0, 0.0, 1.0)), BOX)
    assert points.shape == (0, 3)
    assert triangles.shape == (0, 3)


@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (0.6, 0.0, 0.8)])
def test_a_cylinder_is_a_tube_with_its_corners_on_the_wall(axis: tuple[float, float, float]) -> None:
    shape = Cylinder((0.1, 0.2, 0.7), axis, 0.5)
    points, triangles = triangulate(shape, BOX)
    arm = points - np.array(shape.point)
    radial = arm - np.outer(arm @ np.array(axis), axis)
    assert np.allclose(np.linalg.norm(radial, axis=1), 0.5, rtol=1e-12)
    assert len(triangles) == 2 * FACES
    middle = points[triangles].mean(axis=1) - np.array(shape.point)
    inward = -(middle - np.outer(middle @ np.array(axis), axis))
    assert np.all(np.einsum("ij,ij->i", areas(points, triangles), inward) > 0)
    length = np.ptp(points @ np.array(axis))
    perimeter = 2 * FACES * 0.5 * np.sin(np.pi / FACES)
    assert np.isclose(np.linalg.norm(areas(points, triangles), axis=1).sum(), perimeter * length, rtol=1e-12)


def test_walls_and_fields_of_a_record_become_meshes(bed: Bed, tmp_path: Path) -> None:
    export.write(read_record(bed.folder), "vtu", tmp_path, case=bed.case)
    points, triangles, bodies = wall_triangles(Trajectory(bed.record, bed.scene))
    assert np.array_equal(meshes.read(tmp_path / "walls.stl").corners("triangle"), points[triangles])
    assert np.array_equal(meshes.read(tmp_path / "walls.vtu").cell_data["body"][0], bodies)
    last = meshes.read(tmp_path / "particles" / "000010.vtu")
    assert np.array_equal(last.points, bed.record["position"][10])
    assert np.array_equal(last.point_data["velocity"], bed.record["velocity"][10])


def test_vtk_opens_the_fields(bed: Bed, tmp_path: Path) -> None:
    pytest.importorskip("vtk", reason="vtk is not installed; the extra `viewers` brings it")
    from vtkmodules.util.numpy_support import vtk_to_numpy  # pyright: ignore
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader  # pyright: ignore

    export.write(bed.record, "vtu", tmp_path, case=bed.case)
    reader: Any = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "particles" / "000010.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfCells() == 25
    assert np.array_equal(vtk_to_numpy(grid.GetPointData().GetArray("force")), bed.record["force"][10])
