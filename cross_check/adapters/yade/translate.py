"""From a scene to a YADE deck with Wall bodies; the contact laws stand in `laws`.

YADE keeps velocities at half steps, so the deck starts from v(-1/2) = v0 - g dt/2.
"""

from __future__ import annotations

from pathlib import Path

from cross_check.adapters import capability, paths, start_file
from cross_check.adapters import laws as contact_laws
from cross_check.adapters.capability import AXES, Plane
from cross_check.adapters.interface import Deck, NotComparable, Row
from cross_check.adapters.render import number, numbers, render, table, word
from cross_check.adapters.yade import changes, laws
from cross_check.adapters.yade.changes import vector
from cross_check.scene import Particle, Scene, Vector

MAIN = "scene.py"
PARTICLES = "particles.txt"
WALLS = "walls.txt"
CONTACTS = "contacts.txt"
START = "start.txt"
PARTICLE_COLUMNS = ("step", "id", "x", "y", "z", "vx", "vy", "vz", "wx", "wy", "wz", "fx", "fy", "fz", "tx", "ty", "tz")
IMPORTS = (
    "Bo1_Sphere_Aabb",
    "Bo1_Wall_Aabb",
    "ForceResetter",
    "Ig2_Sphere_Sphere_ScGeom",
    "Ig2_Wall_Sphere_ScGeom",
    "InsertionSortCollider",
    "InteractionLoop",
    "MatchMaker",
    "NewtonIntegrator",
    "O",
)
# Measured: with 64 segments, three or four facets at once push a sphere, 49 to 60 % too hard.
NO_TUBES = "YADE has no inside of a cylinder: a sphere in a tube of facets is counted by every facet that it overlaps"
# Measured: with `allowBiggerThanPeriod` the first steps run and the first new sort never ends; without it YADE aborts.
NO_WALLS_IN_A_CELL = "YADE's collider does not come to an end with a Wall body in a periodic cell"
WALL_COLUMNS = ("step", "id", "fx", "fy", "fz")
CONTACT_COLUMNS = ("step", "id1", "id2", "fx", "fy", "fz")


def _velocity(scene: Scene, index: int, particle: Particle) -> Vector:
    """Velocity [m/s] half a step before the start, which gravity alone makes v0 at the start; driven ones rest."""
    if any(drive.particle == index for drive in scene.drives):
        return particle.velocity
    half = 0.5 * scene.time_step
    (x, y, z), (gx, gy, gz) = particle.velocity, scene.gravity
    return (x - gx * half, y - gy * half, z - gz * half)


def _wall_rows(plane: Plane) -> list[Row]:
    key, place = f"bodies.{plane.name}", number(plane.position)
    rows = [Row(f"{key}.shape.point", place, f"wall axis={plane.axis}", place, "m", f"its {AXES[plane.axis]}")]
    if any(plane.velocity):
        velocity = vector(plane.velocity)
        rows.append(Row(f"{key}.motion.velocity", velocity, "state.vel", velocity, "m/s", "as stated"))
    return rows


def _cell(scene: Scene) -> Vector | None:
    """Edges of the periodic cell [m], None where no axis is periodic.

    YADE is periodic along all axes or none. Along an open one the cell is twice the box that particles do not leave, so
    that nothing meets an image.
    """
    domain = scene.domain
    if "periodic" not in domain.boundary:
        return None
    factors = (1.0 if boundary == "periodic" else 2.0 for boundary in domain.boundary)
    x, y, z = (f * (high - low) for f, low, high in zip(factors, domain.min, domain.max, strict=True))
    return (x, y, z)


def _cell_rows(scene: Scene) -> list[Row]:
    cell = _cell(scene)
    if cell is None:
        return []
    stated = " ".join(scene.domain.boundary)
    return [Row("domain.boundary", stated, "O.cell.setBox", vector(cell), "m", "twice the box along an open axis")]


def deck(scene: Scene) -> Deck:
    """The YADE deck of `scene`. Raises NotComparable or InvalidScene with the reason."""
    contact_laws.comparable(scene, laws.KNOWN)
    capability.check(scene)
    words = laws.words(scene)
    planes = capability.planes(scene, NO_TUBES)
    if planes and _cell(scene) is not None:
        raise NotComparable(NO_WALLS_IN_A_CELL)
    rows = capability.shared_rows(scene, "O.dt", ("NewtonIntegrator gravity", vector(scene.gravity), "as stated"))
    rows += words.material_rows + words.model_rows
    rows += _cell_rows(scene)
    rows += [row for plane in planes for row in _wall_rows(plane)]
    rows += paths.rows(scene, "state.pos, vel, angVel")
    place = START if start_file.many(scene) else "below"
    rows.append(Row("particles[*].velocity", place, "state.vel", place, "m/s", "v(-1/2) = v0 - g dt/2"))
    rows.append(Row("particles[*].mass", place, "state.mass", place, "kg", "as stated"))
    stages = changes.changes(scene)
    rows += [row for change in stages for row in change.rows]
    files = {MAIN: _text(scene, rows, words, planes, stages)}
    if start_file.many(scene):
        files[START] = _start(scene)
    return Deck("yade", scene, files, MAIN, rows)


def _start(scene: Scene) -> str:
    """The particles, one a line: material, radius, mass, moment of inertia, position, velocity, angular velocity."""
    lines: list[str] = []
    for index, particle in enumerate(scene.particles):
        state = (*particle.position, *_velocity(scene, index, particle), *particle.angular_velocity)
        size = (particle.radius, particle.mass, particle.moment_of_inertia)
        lines.append(f"{particle.material} {numbers((*size, *state))}")
    return "\n".join(lines) + "\n"


def _text(scene: Scene, rows: list[Row], words: laws.Words, planes: list[Plane], stages: list[changes.Change]) -> str:
    return render(
        Path(__file__).with_name("scene.py.j2"),
        {
            "name": word(scene.name),
            "main": MAIN,
            "table": table(rows),
            "imports": sorted([*IMPORTS, words.material, words.physics, words.law]),
            "contacts": words,
            "particles": [
                {
                    "material": particle.material,
                    "radius": number(particle.radius),
                    "mass": number(particle.mass),
                    "inertia": number(particle.moment_of_inertia),
                    "position": vector(particle.position),
                    "velocity": vector(_velocity(scene, index, particle)),
                    "angular_velocity": vector(particle.angular_velocity),
                }
                for index, particle in enumerate(scene.particles)
            ],
            "drives": [
                {"index": drive.particle, "stages": paths.stages(scene, drive, paths.ZERO)} for drive in scene.drives
            ],
            "cell": None if (cell := _cell(scene)) is None else vector(cell),
            "walls": [
                {
                    "name": word(plane.name),
                    "material": plane.material,
                    "axis": plane.axis,
                    "position": number(plane.position),
                    "velocity": vector(plane.velocity),
                }
                for plane in planes
            ],
            "skin": number(0.2 * min(particle.radius for particle in scene.particles)),
            "physics": f"{words.physics}({words.physics_words})",
            "newton": f"NewtonIntegrator(damping=0, gravity={vector(scene.gravity)})",
            "changes": stages,
            "start_file": START if start_file.many(scene) else None,
            "contacts_file": CONTACTS if scene.contacts else None,
            "contact_columns": " ".join(CONTACT_COLUMNS),
            "time_step": number(scene.time_step),
            "every": scene.output_every,
            "steps": scene.steps,
            "particles_file": PARTICLES,
            "particle_columns": " ".join(PARTICLE_COLUMNS),
            "walls_file": WALLS,
            "wall_columns": " ".join(WALL_COLUMNS),
        },
    )
