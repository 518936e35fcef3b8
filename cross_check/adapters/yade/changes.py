"""What changes between the stages of a run in YADE: values of contacts, walls and gravity.

A contact keeps the values that it was given when it was born; the deck changes those that are there and what makes new
ones.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from cross_check.adapters import capability, laws
from cross_check.adapters.interface import NotComparable, Row
from cross_check.adapters.render import number, word
from cross_check.adapters.stages import Segment, changed_rows, segments
from cross_check.adapters.yade.laws import betan_of, words
from cross_check.scene import Pair, Scene, Vector

# Values of a pair that YADE keeps in the contact by itself.
CHANGEABLE = ("friction", "damping_ratio")


@dataclass(frozen=True)
class Change:
    """What changes at a step, after the forces of that step: entries of the deck by name, rows of the translation."""

    step: int
    name: str
    entries: list[tuple[str, str]]
    rows: list[Row]


def vector(values: Vector) -> str:
    """`values` as a tuple of Python."""
    return f"({number(values[0])}, {number(values[1])}, {number(values[2])})"


def changes(scene: Scene) -> list[Change]:
    """What changes at the beginning of each stage. Raises NotComparable for values that YADE cannot change."""
    parts = segments(scene)
    found = [_change(after, before) for before, after in zip(parts[:-1], parts[1:], strict=True)]
    return [change for change in found if change.entries]


def _change(segment: Segment, before: Segment) -> Change:
    old, new = before.scene, segment.scene
    entries = _pairs(segment.name, old, new)
    walls = [
        f"{len(new.particles) + index}: {vector(body.motion.velocity or (0.0, 0.0, 0.0))}"
        for index, (body, was) in enumerate(zip(new.bodies, old.bodies, strict=True))
        if body.motion != was.motion
    ]
    if walls:
        entries.append(("walls", "{" + ", ".join(walls) + "}"))
    if new.gravity != old.gravity:
        entries.append(("gravity", vector(new.gravity)))
    rows = changed_rows(segment, _rows(new), _rows(old))
    return Change(segment.first, word(segment.name) if segment.name else "", entries, rows)


def _rows(scene: Scene) -> list[Row]:
    """Rows of what can change."""
    found = [*words(scene).material_rows]
    for body in scene.bodies:
        velocity = vector(body.motion.velocity or (0.0, 0.0, 0.0))
        found.append(Row(f"bodies.{body.name}.motion.velocity", velocity, "state.vel", velocity, "m/s", "as stated"))
    gravity = vector(scene.gravity)
    return [*found, Row("gravity", gravity, "NewtonIntegrator gravity", gravity, "m/s2", "as stated")]


def _pairs(stage: str, old: Scene, new: Scene) -> list[tuple[str, str]]:
    """Entries for the values of pairs that changed; all pairs are stated anew."""
    before, after = capability.touching(old), capability.touching(new)
    for was, pair in zip(before, after, strict=True):
        same = {"restitution": pair.restitution} | {name: getattr(pair, name) for name in CHANGEABLE}
        if replace(was, **same) != pair:
            key = capability.pair_key(new, pair)
            raise NotComparable(
                f"stages.{stage}.{key}: the deck changes {' and '.join(CHANGEABLE)} of YADE's contacts during a run, "
                "the scene changes another value"
            )
    matchers: list[str] = []
    contacts: list[str] = []
    if laws.frictional(new) and [pair.friction for pair in before] != [pair.friction for pair in after]:
        matchers.append(f'"frictAngle": {_values(after, [math.atan(laws.friction(new, pair)) for pair in after])}')
        contacts.append(
            f'"tangensOfFrictionAngle": {_values(after, [laws.friction(new, pair) for pair in after])}'
        )
    if laws.elastic(new) and [pair.damping_ratio for pair in before] != [pair.damping_ratio for pair in after]:
        values = _values(after, [betan_of(pair.damping_ratio) for pair in after])
        for name in ("betan", "betas") if laws.frictional(new) else ("betan",):
            matchers.append(f'"{name}": {values}')
            contacts.append(f'"{name}": {values}')
    if not matchers:
        return []
    return [("matchers", "{" + ", ".join(matchers) + "}"), ("contacts", "{" + ", ".join(contacts) + "}")]


def _values(pairs: list[Pair], values: list[float]) -> str:
    """A value of every pair, by the materials of both sides in order."""
    entries = zip(pairs, values, strict=True)
    return "{" + ", ".join(f"{pair.between}: {number(value)}" for pair, value in entries) + "}"
