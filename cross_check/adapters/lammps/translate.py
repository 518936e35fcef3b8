"""From a scene to a LAMMPS deck; the contact laws stand in `laws`."""

from __future__ import annotations

from pathlib import Path

from cross_check.adapters import capability, paths, start_file
from cross_check.adapters import laws as contact_laws
from cross_check.adapters.dump import CONTACTS, HISTORY, PARTICLES, STATE
from cross_check.adapters.interface import Deck, NotComparable, Row
from cross_check.adapters.lammps import changes, laws
from cross_check.adapters.lammps.walls import force_columns, kinds
from cross_check.adapters.render import number, numbers, render, table, word
from cross_check.scene import Scene

MAIN = "scene.lmp"
# Ids of both particles, normal force and tangential force on the first.
CONTACT_COLUMNS = ("c_pair_ids[1]", "c_pair_ids[2]", *(f"c_pair_forces[{place}]" for place in range(1, 7)))
# LAMMPS has 32 groups, one of them is `all`.
MOST_MATERIALS = 31


def deck(scene: Scene) -> Deck:
    """The LAMMPS deck of `scene`. Raises NotComparable or InvalidScene with the reason."""
    contact_laws.comparable(scene, laws.KNOWN)
    capability.check(scene)
    if len(kinds(scene)) > MOST_MATERIALS:
        raise NotComparable(f"{len(kinds(scene))} materials of particles, LAMMPS has groups for {MOST_MATERIALS}")
    if scene.drives and len(kinds(scene)) + len(scene.drives) + 1 > MOST_MATERIALS:
        raise NotComparable(f"{len(scene.drives)} driven particles, LAMMPS has {MOST_MATERIALS} groups")
    paths.constant_spins(scene, "LAMMPS")
    laws.check(scene)
    pairs = capability.touching(scene)
    stages = changes.stages(scene)
    walls = stages[0].walls
    magnitude, direction = capability.gravity(scene)
    weight = f"{number(magnitude)} vector {numbers(direction)}"
    rows = capability.shared_rows(scene, "timestep", ("fix gravity", weight, "magnitude and direction"))
    rows += [row for pair in pairs for row in laws.pair_rows(scene, pair)]
    rows += laws.model_rows(scene)
    rows += [row for wall in walls for row in wall.rows]
    rows += paths.rows(scene, "fix move variable")
    rows += start_file.rows(scene)
    rows += [row for stage in stages for row in stage.rows]
    files = {MAIN: _text(scene, rows, stages)}
    if start_file.many(scene):
        files[start_file.START] = start_file.data_file(scene, types(scene), len(kinds(scene)))
    return Deck("lammps", scene, files, MAIN, rows)


def _text(scene: Scene, rows: list[Row], stages: list[changes.Stage]) -> str:
    domain, walls = scene.domain, stages[0].walls
    own = kinds(scene)
    bounds = [value for low, high in zip(domain.min, domain.max, strict=True) for value in (low, high)]
    columns = [column for wall in walls for column in force_columns(wall.fix)]
    return render(
        Path(__file__).with_name("scene.lmp.j2"),
        {
            "name": word(scene.name),
            "main": MAIN,
            "table": table(rows),
            "boundary": " ".join("p" if kind == "periodic" else "f" for kind in domain.boundary),
            "bounds": numbers(bounds),
            "materials": [f"{kind} {word(scene.materials[m].name)}" for kind, m in enumerate(own, start=1)],
            "types": len(own),
            "start_file": start_file.START if start_file.many(scene) else None,
            "skin": number(start_file.skin(scene)),
            "search": "bin" if start_file.many(scene) else "nsq",
            "particles": [
                {
                    "id": index,
                    "type": own.index(particle.material) + 1,
                    "position": numbers(particle.position),
                    "diameter": number(2.0 * particle.radius),
                    "mass": number(particle.mass),
                    "velocity": [number(v) for v in particle.velocity],
                    "angular_velocity": numbers(particle.angular_velocity),
                }
                for index, particle in enumerate(scene.particles, start=1)
            ],
            "contacts": laws.comment(scene),
            "pairs": stages[0].pairs,
            "time_step": number(scene.time_step),
            "walls": [{"name": word(wall.body.name), "commands": wall.commands} for wall in walls],
            "gravity": stages[0].gravity,
            "stages": stages,
            "free": bool(paths.free(scene)),
            "every": scene.output_every,
            "steps": scene.steps,
            "history_file": HISTORY,
            "history": " ".join(["id", *STATE, *columns]),
            "particles_file": PARTICLES,
            "contacts_file": CONTACTS if scene.contacts else None,
            "contact_columns": " ".join(CONTACT_COLUMNS),
        },
    )


def wall_columns(scene: Scene) -> list[tuple[int, tuple[str, str, str]]]:
    """Body index and dump columns of every wall fix of the deck."""
    return [(wall.body.index, force_columns(wall.fix)) for wall in changes.stages(scene)[0].walls]


def types(scene: Scene) -> list[int]:
    """Atom type of every particle."""
    own = kinds(scene)
    return [own.index(particle.material) + 1 for particle in scene.particles]
