"""pandas and spreadsheets: tidy CSV tables, units in brackets in the head, numbers that read back to the same bits."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from cross_check.export.trajectory import Trajectory
from cross_check.record import Array

Table = Mapping[str, Any]
"""Columns of equal length by their head; `None` in a column is an empty cell."""


def write(trajectory: Trajectory, folder: Path) -> list[Path]:
    """Writes `particles.csv`, `series.csv`, and `contacts.csv` where the record has contacts."""
    folder.mkdir(parents=True, exist_ok=True)
    samples = range(trajectory.samples)
    written = [
        _table(folder / "particles.csv", (_particles(trajectory, sample) for sample in samples)),
        _table(folder / "series.csv", iter([_series(trajectory)])),
    ]
    if trajectory.has_contacts:
        written.append(_table(folder / "contacts.csv", (_contacts(trajectory, sample) for sample in samples)))
    return written


def _table(path: Path, blocks: Iterator[Table]) -> Path:
    """Writes blocks of one table below one head; the text of a float is the shortest that reads back to its bits."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        for number, block in enumerate(blocks):
            if number == 0:
                writer.writerow(block)
            columns = [values.tolist() if isinstance(values, np.ndarray) else values for values in block.values()]
            writer.writerows(zip(*columns, strict=True))
    return path


def _when(trajectory: Trajectory, sample: int, rows: int) -> dict[str, Any]:
    step, time = int(trajectory.record.step[sample]), float(trajectory.record["time"][sample])
    return {"step": [step] * rows, "time [s]": [time] * rows}


def _vector(name: str, unit: str, values: Any) -> dict[str, Any]:
    """Three columns of a vector, `name_x [unit]` and so on."""
    return {f"{name}_{axis} [{unit}]": values[:, place] for place, axis in enumerate("xyz")}


def _particles(trajectory: Trajectory, sample: int) -> Table:
    position = trajectory.record["position"][sample]
    columns = _when(trajectory, sample, trajectory.count) | {"particle": np.arange(trajectory.count)}
    columns |= {f"{axis} [m]": position[:, place] for place, axis in enumerate("xyz")}
    for field in trajectory.fields():
        values = field.values[sample]
        if field.name == "material" and trajectory.scene is not None:
            names = [material.name for material in trajectory.scene.materials]
            columns["material"] = [names[int(number)] for number in values]
        elif values.ndim == 2:
            columns |= _vector(field.name, field.unit, values)
        else:
            columns[f"{field.name} [{field.unit}]"] = values
    return columns


def _contacts(trajectory: Trajectory, sample: int) -> Table:
    contacts, bodies = trajectory.contacts(sample), trajectory.header.bodies
    columns = _when(trajectory, sample, len(contacts))
    columns["first"] = contacts.first
    columns["second"] = [number if number >= 0 else None for number in contacts.second.tolist()]
    columns["body"] = [bodies[number] if number >= 0 else None for number in contacts.body.tolist()]
    columns |= _vector("start", "m", contacts.start) | _vector("end", "m", contacts.end)
    columns |= _vector("force", "N", contacts.force)
    columns["normal_force [N]"] = _known(contacts.normal_force)
    columns["tangential_force [N]"] = _known(contacts.tangential_force)
    return columns


def _known(values: Array) -> list[float | None]:
    """Numbers, with empty cells for what is not known."""
    return [None if np.isnan(value) else value for value in values.tolist()]


def _series(trajectory: Trajectory) -> Table:
    columns: dict[str, Any] = {"step": trajectory.record.step, "time [s]": trajectory.record["time"]}
    return columns | {f"{item.name} [{item.unit}]": item.values for item in trajectory.series()}
