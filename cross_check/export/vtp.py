"""ParaView and OVITO: one inline, uncompressed VTP file for each sample, and PVD files that give their times.

Compressed and appended VTP files are smaller, but OVITO does not read them. Numbers are written as they are in memory,
in base64, so that a viewer shows the very numbers of the record.
"""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from cross_check.export.trajectory import Trajectory
from cross_check.export.walls import wall_triangles
from cross_check.record import Array

AnyArray = NDArray[np.float64] | NDArray[np.int64]
Content = Callable[[Trajectory, int], bytes]
SECTIONS = ("Verts", "Lines", "Strips", "Polys")


def write(trajectory: Trajectory, folder: Path) -> list[Path]:
    """Writes `particles.pvd`, `contacts.pvd` and `walls.pvd`, as far as the trajectory has them, and their pieces."""
    contents: dict[str, Content] = {"particles": _particles}
    if trajectory.has_contacts:
        contents["contacts"] = _lines
    if trajectory.scene is not None and trajectory.scene.bodies:
        contents["walls"] = _walls
    written: list[Path] = []
    for name, content in contents.items():

        def piece(path: Path, sample: int, content: Content = content) -> None:
            path.write_bytes(content(trajectory, sample))

        written += collection(trajectory, folder, name, ".vtp", piece)
    return written


def polydata(
    points: Array,
    cells: Mapping[str, Sequence[Sequence[int]] | NDArray[np.int64]],
    point_data: Mapping[str, AnyArray],
    cell_data: Mapping[str, AnyArray],
) -> bytes:
    """A VTP file: `points` (P, 3), `cells` of one size by section (Verts, Lines, Polys), data by point and by cell."""
    root = ElementTree.Element(
        "VTKFile", type="PolyData", version="1.0", byte_order="LittleEndian", header_type="UInt64"
    )
    tables = {name: np.asarray(cells.get(name, ()), dtype=np.int64) for name in SECTIONS}
    counts = {f"NumberOf{name}": str(len(table)) for name, table in tables.items()}
    piece = ElementTree.SubElement(ElementTree.SubElement(root, "PolyData"), "Piece", NumberOfPoints=str(len(points)))
    piece.attrib.update(counts)
    for section, data in (("PointData", point_data), ("CellData", cell_data)):
        parent = ElementTree.SubElement(piece, section)
        for name, values in data.items():
            _data_array(parent, name, values)
    _data_array(ElementTree.SubElement(piece, "Points"), "Points", points)
    for name, table in tables.items():
        section = ElementTree.SubElement(piece, name)
        width = table.shape[1] if table.ndim == 2 else 0
        _data_array(section, "connectivity", table.ravel())
        _data_array(section, "offsets", width * np.arange(1, len(table) + 1))
    return ElementTree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"


def _data_array(parent: ElementTree.Element, name: str, values: AnyArray) -> None:
    integer = np.issubdtype(values.dtype, np.integer)
    kind, stored = ("Int64", "<i8") if integer else ("Float64", "<f8")
    raw = np.ascontiguousarray(values, dtype=stored).tobytes()
    length = np.array(len(raw), dtype="<u8").tobytes()
    element = ElementTree.SubElement(parent, "DataArray", type=kind, Name=name, format="binary")
    if values.ndim == 2:
        element.set("NumberOfComponents", str(values.shape[1]))
    element.text = base64.b64encode(length + raw).decode()


def collection(
    trajectory: Trajectory, folder: Path, name: str, suffix: str, write_piece: Callable[[Path, int], object]
) -> list[Path]:
    """Writes `NAME.pvd`, and its pieces `NAME/000000.vtp` ... through `write_piece(path, sample)`; returns the PVD."""
    (folder / name).mkdir(parents=True, exist_ok=True)
    for old in (folder / name).glob(f"[0-9]*{suffix}"):
        old.unlink()  # of a longer run that was exported to the same folder
    root = ElementTree.Element("VTKFile", type="Collection", version="1.0", byte_order="LittleEndian")
    pieces = ElementTree.SubElement(root, "Collection")
    for sample, time in enumerate(trajectory.record["time"]):
        piece = f"{name}/{sample:06}{suffix}"
        write_piece(folder / piece, sample)
        ElementTree.SubElement(pieces, "DataSet", timestep=repr(float(time)), group="", part="0", file=piece)
    ElementTree.indent(root)
    path = folder / f"{name}.pvd"
    path.write_bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")
    return [path]


def _particles(trajectory: Trajectory, sample: int) -> bytes:
    numbers = np.arange(trajectory.count)
    data = {"id": numbers} | {field.name: field.values[sample] for field in trajectory.fields()}
    return polydata(trajectory.record["position"][sample], {"Verts": numbers[:, None]}, data, {})


def _lines(trajectory: Trajectory, sample: int) -> bytes:
    """Contacts as lines. OVITO knows them by the names `id1` and `id2`; `id2` is -1 for a contact with a body."""
    contacts = trajectory.contacts(sample)
    count = len(contacts)
    points: Array = np.reshape(np.stack([contacts.start, contacts.end], axis=1), (2 * count, 3))
    data = {
        "id1": contacts.first,
        "id2": contacts.second,
        "body": contacts.body,
        "kind": (contacts.body >= 0).astype(np.int64),
        "force": contacts.force,
        "force_magnitude": np.linalg.norm(contacts.force, axis=1),
        "normal_force": contacts.normal_force,
        "tangential_force": contacts.tangential_force,
    }
    return polydata(
        points, {"Lines": np.stack([np.arange(0, 2 * count, 2), np.arange(1, 2 * count, 2)], axis=1)}, {}, data
    )


def _walls(trajectory: Trajectory, sample: int) -> bytes:
    points, triangles, bodies = wall_triangles(trajectory, sample)
    return polydata(points, {"Polys": triangles}, {}, {"body": bodies})
