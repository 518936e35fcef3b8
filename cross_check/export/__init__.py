"""Files that people open, made from any run record: ParaView, OVITO, pandas, mesh tools (docs/export.md)."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from cross_check.engine import Case
from cross_check.export import dump, fields, tables, vtp
from cross_check.export.trajectory import ExportError, Trajectory, scene_of
from cross_check.record import RunRecord

__all__ = ["FORMATS", "ExportError", "write"]

FORMATS: dict[str, Callable[[Trajectory, Path], list[Path]]] = {
    "pvd": vtp.write,
    "dump": dump.write,
    "csv": tables.write,
    "vtu": fields.write,
}
WITH_CONTACTS = ("pvd", "dump", "csv")
INDEX = "export.json"


def write(record: RunRecord, to: str, folder: Path, *, case: Case | None = None, contacts: bool = False) -> list[Path]:
    """Writes a record in the format `to` into `folder`; returns the files that a viewer opens, and an index of them.

    The `case` of the record tells materials, domain and walls. With `contacts` true, a record or a format without
    contacts is an error; otherwise they are written where they are there. Raises ExportError, MeshError or OSError.
    """
    if to not in FORMATS:
        raise ExportError(f"no such format {to} (known: {', '.join(FORMATS)})")
    trajectory = Trajectory(record, None if case is None else scene_of(record.header, case))
    if contacts and to not in WITH_CONTACTS:
        raise ExportError(f"the format {to} holds no contacts (these do: {', '.join(WITH_CONTACTS)})")
    if contacts and not trajectory.has_contacts:
        raise ExportError(f"{trajectory.name}: the record holds no contacts (column contact_start is missing)")
    folder.mkdir(parents=True, exist_ok=True)
    written = FORMATS[to](trajectory, folder)
    index = folder / INDEX
    index.write_text(json.dumps(_index(trajectory, to, [path.name for path in written]), indent=1) + "\n")
    return [*written, index]


def _index(trajectory: Trajectory, to: str, files: list[str]) -> dict[str, object]:
    """What the files hold: where they come from and the units, for which most formats have no place."""
    header = trajectory.header
    units = {"position": "m"} | {field.name: field.unit for field in trajectory.fields()}
    if trajectory.has_contacts and to in WITH_CONTACTS:
        units |= {"contact force": "N", "normal_force": "N", "tangential_force": "N"}
    return {
        "source": header.source,
        "case": header.case,
        "variant": header.variant,
        "seed": header.seed,
        "code": {"name": header.code.name, "version": header.code.version},
        "velocity_time": header.velocity_time,
        "contact_force": header.contact_force,
        "bodies": header.bodies,
        "format": to,
        "files": files,
        "units": units,
    }
