"""PVD and VTP files hold the very numbers of the record: read by an XML reader of this test, by VTK and by OVITO."""

from __future__ import annotations

# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# VTK, OVITO and the shapes of arrays are not typed.
import base64
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from small_bed import Bed, without_contacts

from cross_check import export
from cross_check.export.trajectory import Trajectory
from cross_check.geometry import nearest
from cross_check.record import read

TYPES = {"Float64": "<f8", "Int64": "<i8"}


@pytest.fixture(scope="module")
def folder(bed: Bed, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("pvd")
    export.write(bed.record, "pvd", place, case=bed.case, contacts=True)
    return place


def pieces(path: Path) -> list[tuple[float, Path]]:
    """Times and files of a PVD file."""
    root = ElementTree.fromstring(path.read_bytes())  # noqa: S314  written by this very test
    return [(float(item.attrib["timestep"]), path.parent / item.attrib["file"]) for item in root.iter("DataSet")]


def arrays(path: Path) -> dict[str, Any]:
    """Every array of a VTP file by `section/name`."""
    root = ElementTree.fromstring(path.read_bytes())  # noqa: S314  written by this very test
    assert root.attrib["byte_order"] == "LittleEndian"
    assert root.attrib["header_type"] == "UInt64"
    assert "compressor" not in root.attrib
    found: dict[str, Any] = {}
    for section in root.iter("Piece").__next__():
        for item in section:
            raw = base64.b64decode(item.text or "")
            assert int(np.frombuffer(raw[:8], "<u8")[0]) == len(raw) - 8
            values = np.frombuffer(raw[8:], TYPES[item.attrib["type"]])
            width = int(item.attrib.get("NumberOfComponents", "1"))
            found[f"{section.tag}/{item.attrib['Name']}"] = values.reshape(-1, width) if width > 1 else values
    return found


def test_times_and_particles_are_those_of_the_record(bed: Bed, folder: Path) -> None:
    listed = pieces(folder / "particles.pvd")
    assert [time for time, _ in listed] == bed.record["time"].tolist()
    for sample, (_, path) in enumerate(listed):
        read = arrays(path)
        assert np.array_equal(read["Points/Points"], bed.record["position"][sample])
        for name in ("velocity", "angular_velocity", "force", "torque"):
            assert np.array_equal(read[f"PointData/{name}"], bed.record[name][sample])
        assert read["PointData/radius"].tolist() == bed.record.header.radius
        assert read["PointData/material"].tolist() == [particle.material for particle in bed.scene.particles]
        assert read["Verts/connectivity"].tolist() == read["PointData/id"].tolist() == list(range(25))


def test_contacts_run_between_nearest_images_and_to_the_walls(bed: Bed, folder: Path) -> None:
    columns, radius = bed.record.columns, np.array(bed.record.header.radius)
    crossing = walls = 0
    for sample, (_, path) in enumerate(pieces(folder / "contacts.pvd")):
        read = arrays(path)
        rows = slice(*columns["contact_start"][sample : sample + 2])
        assert np.array_equal(read["CellData/force"], columns["contact_force"][rows])
        ends = read["Points/Points"].reshape(-1, 2, 3)
        position = bed.record["position"][sample]
        for (first, second), line, force, pressing, sliding in zip(
            columns["contact_pair"][rows],
            ends,
            read["CellData/force"],
            read["CellData/normal_force"],
            read["CellData/tangential_force"],
            strict=True,
        ):
            assert np.array_equal(line[0], position[first])
            length = float(np.linalg.norm(line[1] - line[0]))
            normal = (line[0] - line[1]) / length
            assert abs(force @ normal - pressing) < 1e-12
            assert abs(np.hypot(pressing, sliding) - np.linalg.norm(force)) < 1e-12
            if second >= len(radius):
                walls += 1
                assert 0.9 * radius[first] < length < radius[first]
                continue
            assert 0 < length < radius[first] + radius[second]
            crossing += np.linalg.norm(position[second] - position[first]) > radius[first] + radius[second]
            assert np.allclose(nearest(bed.scene.domain, position[second] - line[1]), 0, atol=1e-15)
    assert crossing > 0
    assert walls > 0


def test_pieces_of_a_longer_run_are_removed(bed: Bed, tmp_path: Path) -> None:
    (tmp_path / "particles").mkdir()
    for name in ("000099.vtp", "mine.vtp"):
        (tmp_path / "particles" / name).write_text("old")
    export.write(without_contacts(read(bed.folder)), "pvd", tmp_path)
    left = {path.name for path in (tmp_path / "particles").iterdir()}
    assert left == {"mine.vtp"} | {f"{sample:06}.vtp" for sample in range(11)}


def test_contact_forces_add_up_press_and_stay_below_the_cap(bed: Bed, folder: Path) -> None:
    for sample, (_, path) in enumerate(pieces(folder / "contacts.pvd")):
        read = arrays(path)
        total = np.zeros((25, 3))
        np.add.at(total, read["CellData/id1"], read["CellData/force"])
        among = read["CellData/kind"] == 0
        np.add.at(total, read["CellData/id2"][among], -read["CellData/force"][among])
        largest = np.abs(bed.record["force"][sample]).max()
        assert np.allclose(total, bed.record["force"][sample], rtol=0, atol=1e-12 * largest)
        pressing, sliding = read["CellData/normal_force"], read["CellData/tangential_force"]
        assert np.all(pressing >= -1e-12 * largest)
        assert np.all(sliding <= 0.5 * pressing + 1e-9 * largest)  # the normal and the friction of the case


def test_the_force_of_a_wall_points_away_from_it(bed: Bed) -> None:
    trajectory = Trajectory(bed.record, bed.scene)
    floors = [trajectory.contacts(sample) for sample in range(trajectory.samples)]
    chosen = [(item.start - item.end)[item.body == 0] for item in floors]
    across = np.concatenate(chosen)
    assert len(across)
    assert np.all(across[:, 2] > 0)
    assert np.all(across[:, :2] == 0)


def test_moving_walls_move_and_others_rest(bed: Bed, folder: Path) -> None:
    listed = pieces(folder / "walls.pvd")
    start, end = arrays(listed[0][1]), arrays(listed[-1][1])
    moved = end["Points/Points"] - start["Points/Points"]
    corners = start["Polys/connectivity"].reshape(-1, 3)
    for body, way in enumerate(((0, 0, 0), (0, 0.1 * 0.04, 0.2 * 0.04), (0, 0, 0))):
        points = np.unique(corners[start["CellData/body"] == body])
        assert len(points)
        assert np.allclose(moved[points], way, atol=1e-15)


def test_contacts_with_a_body_of_unknown_shape_end_on_the_surface(bed: Bed) -> None:
    chosen = Trajectory(bed.record, bed.scene).contacts(10)
    sample = Trajectory(bed.record).header
    columns = dict(bed.record.columns)
    pairs = columns["contact_pair"]
    columns["contact_pair"] = np.where(pairs[:, 1:] >= len(sample.mass), pairs, [[0, len(sample.mass)]])
    found = Trajectory(type(bed.record)(sample, columns)).contacts(10)
    assert np.all(np.isnan(found.normal_force))
    assert np.all(np.isnan(found.tangential_force))
    reach = np.linalg.norm(found.end - found.start, axis=1)
    assert np.allclose(reach, np.array(sample.radius)[found.first], rtol=1e-12)
    across = np.cross(found.start - found.end, found.force)
    assert np.allclose(across, 0, atol=1e-15)
    assert len(found) == len(chosen)


def test_vtk_opens_the_very_numbers(bed: Bed, folder: Path) -> None:
    pytest.importorskip("vtk", reason="vtk is not installed; the extra `viewers` brings it")
    from vtkmodules.util.numpy_support import vtk_to_numpy  # pyright: ignore
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader  # pyright: ignore

    def opened(path: Path) -> Any:
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        assert reader.GetErrorCode() == 0
        return reader.GetOutput()

    sample = 9
    particles = opened(folder / "particles" / f"{sample:06}.vtp")
    assert np.array_equal(vtk_to_numpy(particles.GetPoints().GetData()), bed.record["position"][sample])
    for name in ("velocity", "angular_velocity", "force", "torque"):
        assert np.array_equal(vtk_to_numpy(particles.GetPointData().GetArray(name)), bed.record[name][sample])
    contacts = opened(folder / "contacts" / f"{sample:06}.vtp")
    rows = slice(*bed.record.columns["contact_start"][sample : sample + 2])
    assert contacts.GetNumberOfLines() == rows.stop - rows.start > 0
    forces = vtk_to_numpy(contacts.GetCellData().GetArray("force"))
    assert np.array_equal(forces, bed.record.columns["contact_force"][rows])
    assert opened(folder / "walls" / f"{sample:06}.vtp").GetNumberOfPolys() > 64
    assert opened(folder / "contacts" / "000000.vtp").GetNumberOfLines() == 0


def test_ovito_opens_the_series(bed: Bed, folder: Path) -> None:
    io: Any = pytest.importorskip("ovito.io", reason="ovito is not installed; the extra `viewers` brings it")
    pipeline = io.import_file(str(folder / "particles.pvd"))
    assert pipeline.source.num_frames == len(bed.record.step)
    shown = pipeline.compute(9)
    assert np.array_equal(shown.particles.positions[...], bed.record["position"][9])
    assert np.allclose(shown.particles["Radius"][...], bed.record.header.radius, rtol=1e-6)  # single precision there
    contacts = io.import_file(str(folder / "contacts.pvd")).compute(9)
    count = int(np.diff(bed.record.columns["contact_start"])[9])
    assert contacts.lines["particle-particle-contacts"].count >= count > 0
