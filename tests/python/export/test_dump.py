"""LAMMPS text dumps: read by a strict parser of this test, by LAMMPS itself and by OVITO."""

from __future__ import annotations

# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# OVITO and the shapes of arrays are not typed.
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_bed import Bed, without_contacts

from cross_check import export

BOX = [[-0.005, 0.005], [-0.005, 0.005], [0.0, 0.02]]


@pytest.fixture(scope="module")
def folder(bed: Bed, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("dump")
    export.write(bed.record, "dump", place, case=bed.case)
    return place


def frames(path: Path, what: str) -> list[dict[str, Any]]:
    """The snapshots of a dump: step, time, boundary, box, and the columns by name."""
    lines = iter(path.read_text().splitlines())
    assert [next(lines), next(lines)] == ["ITEM: UNITS", "si"]
    found: list[dict[str, Any]] = []
    for line in lines:
        assert line == "ITEM: TIME"
        time = float(next(lines))
        assert next(lines) == "ITEM: TIMESTEP"
        step = int(next(lines))
        assert next(lines) == f"ITEM: NUMBER OF {what}"
        count = int(next(lines))
        head = next(lines).split()
        assert head[:3] == ["ITEM:", "BOX", "BOUNDS"]
        box = [[float(word) for word in next(lines).split()] for _ in range(3)]
        names = next(lines).removeprefix(f"ITEM: {what} ").split()
        rows = np.array([[float(word) for word in next(lines).split()] for _ in range(count)]).reshape(
            count, len(names)
        )
        columns = dict(zip(names, rows.T, strict=True))
        found.append({"time": time, "step": step, "boundary": head[3:], "box": box, **columns})
    return found


def stacked(frame: dict[str, Any], *names: str) -> Any:
    return np.stack([frame[name] for name in names], axis=1)


def test_atoms_are_the_particles_of_the_record(bed: Bed, folder: Path) -> None:
    read = frames(folder / "particles.dump", "ATOMS")
    assert [frame["step"] for frame in read] == bed.record.step.tolist()
    assert [frame["time"] for frame in read] == bed.record["time"].tolist()
    images: set[float] = set()
    for sample, frame in enumerate(read):
        assert frame["boundary"] == ["pp", "ff", "ff"]
        assert frame["box"] == BOX
        assert frame["id"].tolist() == list(range(1, 26))
        assert frame["type"].tolist() == [particle.material + 1 for particle in bed.scene.particles]
        assert frame["radius"].tolist() == bed.record.header.radius
        assert np.array_equal(stacked(frame, "vx", "vy", "vz"), bed.record["velocity"][sample])
        assert np.array_equal(stacked(frame, "omegax", "omegay", "omegaz"), bed.record["angular_velocity"][sample])
        assert np.array_equal(stacked(frame, "fx", "fy", "fz"), bed.record["force"][sample])
        wrapped, image = stacked(frame, "x", "y", "z"), stacked(frame, "ix", "iy", "iz")
        assert np.all((wrapped[:, 0] >= -0.005) & (wrapped[:, 0] <= 0.005))
        position = bed.record["position"][sample]
        assert np.allclose(wrapped + image * (0.01, 0.01, 0.02), position, rtol=0, atol=1e-17)
        assert np.array_equal(wrapped[:, 1:], position[:, 1:])
        images |= set(frame["ix"].tolist())
    assert len(images) > 1


def test_without_a_case_the_box_holds_every_particle_and_positions_are_exact(bed: Bed, tmp_path: Path) -> None:
    export.write(without_contacts(bed.record), "dump", tmp_path)
    assert not (tmp_path / "contacts.dump").exists()
    for sample, frame in enumerate(frames(tmp_path / "particles.dump", "ATOMS")):
        assert frame["boundary"] == ["ff", "ff", "ff"]
        position = stacked(frame, "x", "y", "z")
        assert np.array_equal(position, bed.record["position"][sample])
        low, high = np.array(frame["box"]).T
        assert np.all((position - frame["radius"][:, None] >= low) & (position + frame["radius"][:, None] <= high))


def test_contacts_are_divided_between_pairs_and_bodies(bed: Bed, folder: Path) -> None:
    pairs = frames(folder / "contacts.dump", "ENTRIES")
    bodies = frames(folder / "body_contacts.dump", "ENTRIES")
    columns = bed.record.columns
    for sample, (among, walls) in enumerate(zip(pairs, bodies, strict=True)):
        rows = slice(*columns["contact_start"][sample : sample + 2])
        pair, force = columns["contact_pair"][rows], columns["contact_force"][rows]
        wall = pair[:, 1] >= 25
        assert np.array_equal(stacked(among, "id1", "id2"), pair[~wall] + 1)
        assert np.array_equal(stacked(among, "fx", "fy", "fz"), force[~wall])
        assert np.array_equal(walls["body"], pair[wall][:, 1] - 25 + 1)
        assert np.array_equal(stacked(walls, "fx", "fy", "fz"), force[wall])


def test_lammps_reads_the_dump_back(bed: Bed, folder: Path, tmp_path: Path) -> None:
    program = shutil.which("lmp") or shutil.which("lammps")
    if program is None:
        pytest.skip("lammps is not installed")
    deck = f"""
        units si
        atom_style sphere
        boundary p f f
        region box block -0.005 0.005 -0.005 0.005 0 0.02
        create_box 3 box
        read_dump {folder / "particles.dump"} {int(bed.record.step[-1])} x y z vx vy vz ix iy iz box no add yes
        write_dump all custom back.dump id x y z vx vy vz modify sort id format float %.17g
        """
    (tmp_path / "in.read").write_text("\n".join(line.strip() for line in deck.splitlines()))
    command = [program, "-in", "in.read", "-log", "none", "-nocite"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    assert (tmp_path / "back.dump").is_file(), done.stdout + done.stderr
    rows = [line.split() for line in (tmp_path / "back.dump").read_text().splitlines()[9:]]
    back = np.array(rows, dtype=float)
    last = frames(folder / "particles.dump", "ATOMS")[-1]
    assert np.allclose(back[:, 1:4], stacked(last, "x", "y", "z"), rtol=0, atol=1e-17)
    assert np.array_equal(back[:, 4:7], bed.record["velocity"][-1])


def test_ovito_opens_particles_and_contacts(bed: Bed, folder: Path) -> None:
    io: Any = pytest.importorskip("ovito.io", reason="ovito is not installed; the extra `viewers` brings it")
    modifiers: Any = pytest.importorskip("ovito.modifiers")
    pipeline = io.import_file(str(folder / "particles.dump"))
    assert pipeline.source.num_frames == len(bed.record.step)
    contacts = modifiers.LoadTrajectoryModifier()
    mapping = ["Particle Identifiers.1", "Particle Identifiers.2", *[None] * 9, "normal_force", "tangential_force"]
    contacts.source.load(str(folder / "contacts.dump"), columns=mapping)
    pipeline.modifiers.append(contacts)
    shown = pipeline.compute(9)
    assert shown.attributes["Time"] == bed.record["time"][9]
    # Its reader of decimal numbers rounds the last bit otherwise than most.
    assert np.allclose(shown.particles["Velocity"][...], bed.record["velocity"][9], rtol=1e-15, atol=0)
    rows = slice(*bed.record.columns["contact_start"][9:11])
    pair = bed.record.columns["contact_pair"][rows]
    assert np.array_equal(shown.particles.bonds.topology[...], pair[pair[:, 1] < 25])
