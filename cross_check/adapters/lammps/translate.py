"""From a scene to a LAMMPS deck; the contact laws stand in `laws`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from cross_check.adapters import capability
from cross_check.adapters.capability import AXES, Plane, Tube
from cross_check.adapters.dump import HISTORY, PARTICLES, STATE
from cross_check.adapters.interface import Deck, NotComparable, Row
from cross_check.adapters.lammps import laws
from cross_check.adapters.render import number, numbers, render, table, word
from cross_check.scene import Pair, Scene

MAIN = "scene.lmp"
WITHOUT_BINS = 64
# LAMMPS has 32 groups, one of them is `all`.
MOST_MATERIALS = 31


@dataclass(frozen=True)
class Wall:
    """The fix of one body for one material of particles: commands and rows of the translation."""

    fix: str
    body: Plane | Tube
    commands: list[str]
    rows: list[Row]


def _kinds(scene: Scene) -> list[int]:
    """Material index of each atom type, in the order of the types: the materials of the particles only."""
    return sorted({particle.material for particle in scene.particles})


def _moved(wall: Plane | Tube) -> tuple[list[str], str, list[Row]]:
    """Commands and words that move a region by variables, and their row; none for a wall at rest."""
    if not any(wall.velocity):
        return [], "", []
    variables = [f"move_{wall.index + 1}_{name}" for name in AXES]
    commands = [f"variable {v} equal {number(u)}*time" for v, u in zip(variables, wall.velocity, strict=True)]
    velocity, key = numbers(wall.velocity), f"bodies.{wall.name}.motion.velocity"
    row = Row(key, velocity, f"variable move_{wall.index + 1}_*", velocity, "m/s", "velocity * time")
    return commands, f" move {' '.join('v_' + v for v in variables)}", [row]


def _tube(tube: Tube) -> tuple[str, list[str], list[Row]]:
    """A cylinder is a region, because `zcylinder` stands at the origin only; R* = 2 R Rc / (2 Rc - R)."""
    name, values = f"tube_{tube.index + 1}", numbers((*tube.place, tube.radius))
    commands, move, rows = _moved(tube)
    commands.append(f"region {name} cylinder {AXES[tube.axis]} {values} INF INF side in{move} units box")
    row = Row(f"bodies.{tube.name}.shape", values, f"region {name}", values, "m", "axis, radius; R* = 2R Rc/(2Rc - R)")
    return f"region {name}", commands, [row, *rows]


def _place(plane: Plane) -> tuple[str, list[str], list[Row]]:
    """The words that place a plane in its fix, the commands that must stand before, and the rows of the translation.

    A plane that moves is a region, whose displacement LAMMPS takes from variables.
    """
    key, number_of, axis = f"bodies.{plane.name}", plane.index + 1, AXES[plane.axis]
    position = number(plane.position)
    if not any(plane.velocity):
        sides = f"{position} NULL" if plane.side > 0 else f"NULL {position}"
        row = Row(f"{key}.shape.point", position, f"wall_{number_of} {axis}plane", sides, "m", "lo above, hi below")
        return f"{axis}plane {sides}", [], [row]
    commands, move, moved = _moved(plane)
    point, normal = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    point[plane.axis], normal[plane.axis] = plane.position, float(plane.side)
    region = f"region plane_{number_of} plane {numbers(point)} {numbers(normal)} side in"
    commands.append(f"{region}{move} units box")
    row = Row(f"{key}.shape.point", position, f"region plane_{number_of}", position, "m", f"its {axis}")
    return f"region plane_{number_of}", commands, [row, *moved]


def _walls(scene: Scene) -> list[Wall]:
    walls: list[Wall] = []
    pairs = {pair.between: pair for pair in capability.touching(scene)}
    for body in capability.walls(scene):
        words, before, rows = _tube(body) if isinstance(body, Tube) else _place(body)
        style = "wall/gran/region" if before else "wall/gran"
        for kind, material in enumerate(_kinds(scene), start=1):
            pair = pairs[min(material, body.material), max(material, body.material)]
            fix = f"wall_{body.index + 1}_{kind}"
            model = f"{style} granular {laws.coefficients(scene, pair)}"
            commands = [*before, f"fix {fix} type_{kind} {model} {words} contacts"]
            walls.append(Wall(fix, body, commands, rows))
            before, rows = [], []
    return walls


def deck(scene: Scene) -> Deck:
    """The LAMMPS deck of `scene`. Raises NotComparable or InvalidScene with the reason."""
    capability.check(scene)
    if len(_kinds(scene)) > MOST_MATERIALS:
        raise NotComparable(f"{len(_kinds(scene))} materials of particles, LAMMPS has groups for {MOST_MATERIALS}")
    laws.check(scene)
    pairs = capability.touching(scene)
    walls = _walls(scene)
    magnitude, direction = capability.gravity(scene)
    weight = f"{number(magnitude)} vector {numbers(direction)}"
    rows = capability.shared_rows(scene, "timestep", ("fix gravity", weight, "magnitude and direction"))
    rows += [row for pair in pairs for row in laws.pair_rows(scene, pair)]
    rows += laws.model_rows(scene)
    rows += [row for wall in walls for row in wall.rows]
    rows.append(Row("particles[*].radius", "below", "diameter", "below", "m", "2 R"))
    rows.append(Row("particles[*].mass", "below", "mass", "below", "kg", "as stated"))
    return Deck("lammps", scene, {MAIN: _text(scene, rows, pairs, walls)}, MAIN, rows)


def _pair_lines(scene: Scene, pairs: Sequence[Pair]) -> list[dict[str, str]]:
    """One `pair_coeff` per pair of atom types; types that never touch get a contact without stiffness."""
    kinds = _kinds(scene)
    stated = {pair.between: pair for pair in pairs}
    lines: list[dict[str, str]] = []
    for i, first in enumerate(kinds):
        for j, second in enumerate(kinds[i:], start=i):
            pair = stated.get((first, second))
            names = f"{word(scene.materials[first].name)} with {word(scene.materials[second].name)}"
            if pair is None:
                words = f"{i + 1} {j + 1} {laws.no_contact(scene)}"
                lines.append({"comment": f"{names}: never touch here", "words": words})
            else:
                words = f"{i + 1} {j + 1} {laws.coefficients(scene, pair)}"
                lines.append({"comment": names, "words": words})
    return lines


def _text(scene: Scene, rows: list[Row], pairs: Sequence[Pair], walls: Sequence[Wall]) -> str:
    domain = scene.domain
    kinds = _kinds(scene)
    magnitude, direction = capability.gravity(scene)
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
            "materials": [f"{kind} {word(scene.materials[m].name)}" for kind, m in enumerate(kinds, start=1)],
            "types": len(kinds),
            "skin": number(min(particle.radius for particle in scene.particles)),
            "search": "nsq" if len(scene.particles) <= WITHOUT_BINS else "bin",
            "particles": [
                {
                    "id": index,
                    "type": kinds.index(particle.material) + 1,
                    "position": numbers(particle.position),
                    "diameter": number(2.0 * particle.radius),
                    "mass": number(particle.mass),
                    "velocity": [number(v) for v in particle.velocity],
                    "angular_velocity": numbers(particle.angular_velocity),
                }
                for index, particle in enumerate(scene.particles, start=1)
            ],
            "contacts": laws.comment(scene),
            "pairs": _pair_lines(scene, pairs),
            "time_step": number(scene.time_step),
            "walls": [{"name": word(wall.body.name), "commands": wall.commands} for wall in walls],
            "gravity": number(magnitude),
            "direction": numbers(direction),
            "every": scene.output_every,
            "steps": scene.steps,
            "history_file": HISTORY,
            "history": " ".join(["id", *STATE, *columns]),
            "particles_file": PARTICLES,
        },
    )


def force_columns(fix: str) -> tuple[str, str, str]:
    """Per-atom columns of a wall fix with keyword `contacts`: its force [N] on each particle."""
    return (f"f_{fix}[2]", f"f_{fix}[3]", f"f_{fix}[4]")


def wall_columns(scene: Scene) -> list[tuple[int, tuple[str, str, str]]]:
    """Body index and dump columns of every wall fix of the deck."""
    return [(wall.body.index, force_columns(wall.fix)) for wall in _walls(scene)]


def types(scene: Scene) -> list[int]:
    """Atom type of every particle."""
    kinds = _kinds(scene)
    return [kinds.index(particle.material) + 1 for particle in scene.particles]
