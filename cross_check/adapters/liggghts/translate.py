"""From a scene to a LIGGGHTS deck; the contact laws stand in `laws`, the planes in `walls`."""

from __future__ import annotations

from pathlib import Path

from cross_check.adapters import capability, paths, start_file
from cross_check.adapters import laws as contact_laws
from cross_check.adapters.dump import CONTACTS, HISTORY, PARTICLES, STATE
from cross_check.adapters.interface import Deck, NotComparable, Row
from cross_check.adapters.liggghts import changes, laws
from cross_check.adapters.liggghts.walls import Wall, pushed, wall_of
from cross_check.adapters.render import number, numbers, render, table, word
from cross_check.scene import Scene

MAIN = "scene.in"
# Ids of both particles and the force on the first; the third column tells images apart.
CONTACT_COLUMNS = tuple(f"c_pairs[{place}]" for place in (1, 2, 4, 5, 6))
# LIGGGHTS has 32 groups, one of them is `all`.
MOST_GROUPS = 31


def deck(scene: Scene) -> Deck:
    """The LIGGGHTS deck of `scene`. Raises NotComparable or InvalidScene with the reason."""
    contact_laws.comparable(scene, laws.KNOWN)
    capability.check(scene)
    if len(scene.drives) + 1 > MOST_GROUPS:
        raise NotComparable(f"{len(scene.drives)} driven particles, LIGGGHTS has {MOST_GROUPS} groups")
    paths.constant_spins(scene, "LIGGGHTS")
    words = laws.words(scene)
    meshes = pushed(scene)
    walls = [wall_of(wall, scene.domain, words.model, words.settings, meshes) for wall in capability.walls(scene)]
    magnitude, direction = capability.gravity(scene)
    weight = f"{number(magnitude)} vector {numbers(direction)}"
    rows = capability.shared_rows(scene, "timestep", ("fix gravity", weight, "magnitude and direction"))
    rows += words.material_rows + words.model_rows
    rows += [row for wall in walls for row in wall.rows]
    rows += paths.rows(scene, "fix move variable")
    rows += start_file.rows(scene)
    stages = changes.stages(scene)
    rows += [row for stage in stages for row in stage.rows]
    files = {MAIN: _text(scene, rows, words, walls, stages)}
    for wall in walls:
        files |= wall.files
    if start_file.many(scene):
        types = [particle.material + 1 for particle in scene.particles]
        files[start_file.START] = start_file.data_file(scene, types, len(scene.materials))
    return Deck("liggghts", scene, files, MAIN, rows)


def _text(scene: Scene, rows: list[Row], words: laws.Words, walls: list[Wall], stages: list[changes.Stage]) -> str:
    meshes = any(wall.files for wall in walls)
    magnitude, direction = capability.gravity(scene)
    domain = scene.domain
    bounds = [value for low, high in zip(domain.min, domain.max, strict=True) for value in (low, high)]
    history = ["id", *STATE, *(column for _, columns in wall_columns(scene) for column in columns)]
    return render(
        Path(__file__).with_name("scene.in.j2"),
        {
            "name": word(scene.name),
            "main": MAIN,
            "table": table(rows),
            "boundary": " ".join("p" if kind == "periodic" else "f" for kind in domain.boundary),
            "bounds": numbers(bounds),
            "materials": [f"{index + 1} {word(m.name)}" for index, m in enumerate(scene.materials)],
            "types": len(scene.materials),
            "start_file": start_file.START if start_file.many(scene) else None,
            "skin": number(start_file.skin(scene)),
            # Bins of few particles would be too many in a large domain; meshes need them.
            "search": "bin" if meshes or start_file.many(scene) else "nsq",
            "particles": [
                {
                    "id": index + 1,
                    "type": particle.material + 1,
                    "position": numbers(particle.position),
                    "diameter": number(2.0 * particle.radius),
                    "mass": number(particle.mass),
                    "velocity": [number(v) for v in particle.velocity],
                    "angular_velocity": [number(w) for w in particle.angular_velocity],
                }
                for index, particle in enumerate(scene.particles)
            ],
            "properties": words.properties,
            "model": words.model,
            "settings": words.settings,
            "contacts": words.comment,
            "time_step": number(scene.time_step),
            "walls": walls,
            "gravity": number(magnitude),
            "direction": numbers(direction),
            "stages": stages,
            "free": bool(paths.free(scene)),
            "every": scene.output_every,
            "steps": scene.steps,
            "history_file": HISTORY,
            "history": " ".join(history),
            "history_format": " ".join(["%d"] + ["%.17g"] * (len(history) - 1)),
            "particles_file": PARTICLES,
            "contacts_file": CONTACTS if scene.contacts else None,
            "contact_columns": " ".join(CONTACT_COLUMNS),
        },
    )


def wall_columns(scene: Scene) -> list[tuple[int, tuple[str, str, str]]]:
    """Body index and dump columns of every wall: its force [N] on each particle, as `store_force yes` keeps it."""
    names = [f"f_force_wall_{index + 1}" for index in range(len(scene.bodies))]
    return [(index, (f"{name}[1]", f"{name}[2]", f"{name}[3]")) for index, name in enumerate(names)]
