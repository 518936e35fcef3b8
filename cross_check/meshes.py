"""Meshes and fields through meshio: only formats that it writes whole, and every file is read back after it is written.

meshio 5.3.5 writes some formats corrupt with numpy 2, and ends the program at a file that it cannot read; both are kept
from the rest of the package here.
"""

from __future__ import annotations

import contextlib
import io
from collections.abc import Generator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cross_check.record import Array

# pyright: reportUnknownMemberType=false, reportUnknownArgumentType=false, reportUnknownVariableType=false
# meshio leaves most of its arguments and attributes untyped.

AnyArray = NDArray[Any]
SOLID = ("vertex", "line", "triangle", "quad", "tetra", "hexahedron")


class MeshError(Exception):
    """A mesh that cannot be read or written: the message names the file, what is wrong and what is allowed."""


@dataclass(frozen=True)
class Mesh:
    """Points (P, 3) [m] and blocks of cells, each a kind and the points of its cells (C, k), counted from 0.

    `point_data` has values (P, ...) by name, `cell_data` one array (C, ...) for each block.
    """

    points: Array
    cells: list[tuple[str, AnyArray]] = field(default_factory=list[tuple[str, AnyArray]])
    point_data: dict[str, AnyArray] = field(default_factory=dict[str, AnyArray])
    cell_data: dict[str, list[AnyArray]] = field(default_factory=dict[str, list[AnyArray]])

    def corners(self, kind: str) -> Array:
        """The places of the corners of all cells of one kind [m], shape (C, k, 3)."""
        found = [self.points[cells] for name, cells in self.cells if name == kind]
        return np.concatenate(found) if found else np.empty((0, 0, 3))


@dataclass(frozen=True)
class Format:
    """What a format holds: kinds of cells, whether values go with points and cells, and options for meshio."""

    cells: tuple[str, ...]
    data: bool
    options: dict[str, Any] = field(default_factory=dict[str, Any])


#: Formats by suffix, all of which bring back the bits that were written. Binary STL is not one of them.
FORMATS = {
    ".vtu": Format(SOLID, data=True),
    ".vtk": Format(SOLID, data=True),
    ".xdmf": Format(SOLID, data=True, options={"data_format": "XML"}),
    ".stl": Format(("triangle",), data=False, options={"binary": False}),
    ".ply": Format(("triangle", "quad"), data=False, options={"binary": False}),
    ".obj": Format(("triangle", "quad"), data=False),
    ".off": Format(("triangle",), data=False),
}


def read(path: Path) -> Mesh:
    """The mesh of a file. Raises MeshError for other formats and for files that meshio cannot read."""
    _format(path)
    if not path.is_file():
        raise MeshError(f"{path}: no such file")
    import meshio  # here: it takes longer to load than the rest of the package

    with _guarded(path, "cannot be read"):
        raw = meshio.read(path)
    if len(raw.points) == 0:  # its readers of STL and OBJ pass over what they do not know
        raise MeshError(f"{path}: holds no points")
    return Mesh(
        points=_native(raw.points),
        cells=[(block.type, _native(block.data)) for block in raw.cells],
        point_data={name: _native(values) for name, values in raw.point_data.items()},
        cell_data={name: [_native(block) for block in values] for name, values in raw.cell_data.items()},
    )


def write(path: Path, mesh: Mesh) -> None:
    """Writes a mesh in the format of the suffix and reads it back; points without cells get cells of one vertex.

    Raises MeshError, and leaves no file, where the format cannot hold the mesh or does not bring it back.
    """
    form = _format(path)
    if not mesh.cells:
        mesh = replace(mesh, cells=[("vertex", np.arange(len(mesh.points))[:, None])])
    unfit = sorted({kind for kind, _ in mesh.cells} - set(form.cells))
    if unfit:
        raise MeshError(f"{path}: {path.suffix} holds no cells of kind {', '.join(unfit)} ({', '.join(form.cells)})")
    if (mesh.point_data or mesh.cell_data) and not form.data:
        able = ", ".join(suffix for suffix, other in FORMATS.items() if other.data)
        raise MeshError(f"{path}: {path.suffix} holds no values at points or cells (these do: {able})")
    path.parent.mkdir(parents=True, exist_ok=True)
    import meshio

    cells: Any = mesh.cells
    data: dict[str, Any] = {"point_data": mesh.point_data, "cell_data": mesh.cell_data}
    raw = meshio.Mesh(mesh.points, cells, **data)
    try:
        with _guarded(path, "cannot be written"):
            meshio.write(path, raw, **form.options)
        _compare(path, mesh, read(path))
    except MeshError:
        path.unlink(missing_ok=True)
        raise


def _format(path: Path) -> Format:
    if path.suffix not in FORMATS:
        raise MeshError(f"{path}: no such mesh format {path.suffix!r} (known: {', '.join(FORMATS)})")
    return FORMATS[path.suffix]


@contextlib.contextmanager
def _guarded(path: Path, what: str) -> Generator[None]:
    """Turns whatever meshio does at a file that it does not understand into a MeshError."""
    said = io.StringIO()
    try:
        # Its reader of STL takes letters for a number of triangles first, and overflows.
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), np.errstate(over="ignore"):
            yield
    except OSError:
        raise
    except ModuleNotFoundError as error:
        raise MeshError(f"{path}: {path.suffix} needs {error.name}: pip install {error.name}") from error
    except (Exception, SystemExit) as error:  # its readers raise many kinds of errors: one message for all
        reason = " ".join(said.getvalue().split()) or repr(error)
        raise MeshError(f"{path}: {what} ({reason})") from error


def _native(values: Any) -> AnyArray:
    """An array in the byte order of this machine."""
    array = np.asarray(values)
    return array.astype(array.dtype.newbyteorder("="))


def _compare(path: Path, mesh: Mesh, back: Mesh) -> None:
    """Raises MeshError unless the mesh that was read back has the corners and values that were written."""
    for kind in dict.fromkeys(kind for kind, _ in mesh.cells):
        if not np.array_equal(mesh.corners(kind), back.corners(kind)):
            raise MeshError(f"{path}: cells of kind {kind} do not read back as they were written")
    for name, values in mesh.point_data.items():
        if name not in back.point_data or not _same(values, back.point_data[name]):
            raise MeshError(f"{path}: values {name} at points do not read back as they were written")
    for name, blocks in mesh.cell_data.items():
        found = back.cell_data.get(name, [])
        if len(found) != len(blocks) or not all(map(_same, blocks, found)):
            raise MeshError(f"{path}: values {name} of cells do not read back as they were written")


def _same(left: AnyArray, right: AnyArray) -> bool:
    return np.array_equal(left, right, equal_nan=bool(np.issubdtype(left.dtype, np.floating)))
