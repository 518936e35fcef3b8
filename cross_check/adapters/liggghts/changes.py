"""What changes between the stages of a run in LIGGGHTS: properties and gravity again, walls taken away and made anew."""

from __future__ import annotations

from dataclasses import dataclass, field

from cross_check.adapters import capability
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.liggghts import laws
from cross_check.adapters.liggghts.walls import Wall, pushed, wall_of
from cross_check.adapters.render import number, numbers, word
from cross_check.adapters.stages import Segment, changed_rows, moves, segments
from cross_check.scene import Scene

# LIGGGHTS starts every `run` with forces evaluated anew.
AGAIN = "forces of the step evaluated anew, springs as they are"


@dataclass(frozen=True)
class Stage:
    """One `run`: its number of steps, what driven particles follow, commands before it and rows of the translation."""

    steps: int
    moves: object
    commands: list[str] = field(default_factory=list[str])
    rows: list[Row] = field(default_factory=list[Row])


@dataclass(frozen=True)
class _Part:
    """What holds in a part of a run."""

    words: laws.Words
    properties: list[str]
    walls: list[Wall]
    gravity: str
    rows: list[Row]


def stages(scene: Scene) -> list[Stage]:
    """Every `run` of the deck. Raises NotComparable for what cannot change."""
    meshes = pushed(scene)
    found: list[Stage] = []
    before: _Part | None = None
    for segment, leg in zip(segments(scene), moves(scene), strict=True):
        part = _part(segment.scene, meshes)
        commands, rows = ([], []) if before is None else _change(segment, before, part)
        found.append(Stage(segment.steps, leg, commands, rows))
        before = part
    return found


def _part(scene: Scene, meshes: set[int]) -> _Part:
    words = laws.words(scene)
    walls = [wall_of(wall, scene.domain, words.model, words.settings, meshes) for wall in capability.walls(scene)]
    magnitude, direction = capability.gravity(scene)
    weight = f"{number(magnitude)} vector {numbers(direction)}"
    gravity = Row("gravity", numbers(scene.gravity), "fix gravity", weight, "m/s2", "magnitude and direction")
    rows = [gravity, *words.material_rows, *words.model_rows, *(row for wall in walls for row in wall.rows)]
    return _Part(words, _whole(words.properties), walls, f"fix gravity all gravity {weight}", rows)


def _whole(lines: list[str]) -> list[str]:
    """Commands with the lines that continue them."""
    found: list[str] = []
    for line in lines:
        if found and found[-1].endswith("&"):
            found[-1] += "\n" + line
        else:
            found.append(line)
    return found


def _change(segment: Segment, before: _Part, part: _Part) -> tuple[list[str], list[Row]]:
    """Commands and rows of what a part has other than the part before."""
    if (part.words.model, part.words.settings) != (before.words.model, before.words.settings):
        raise NotComparable(f"stages.{segment.name}: LIGGGHTS does not change the contact model during a run")
    commands = [f"# stage {word(segment.name)}: {AGAIN}"] if segment.name else []
    commands += [line for line in part.properties if line not in before.properties]
    rows = changed_rows(segment, part.rows, before.rows)
    for old, new in zip(before.walls, part.walls, strict=True):
        if old.commands == new.commands:
            continue
        commands += [f"unfix {_fix(line)}" for line in reversed(old.commands) if line not in new.commands]
        commands += [line for line in new.commands if line not in old.commands]
        # A mesh stays where it is and keeps its contacts; only what moves it changes.
        if not new.files:
            key, fix = f"stages.{segment.name}.bodies.{new.name}", _fix(new.commands[-1])
            rows.append(Row(key, "changed", f"unfix, fix {fix}", "", "-", "drops the springs of its contacts"))
    if part.gravity != before.gravity:
        commands.append(part.gravity)
    return commands, rows


def _fix(command: str) -> str:
    """The id that a `fix` command gives."""
    return command.split()[1]
