"""Asks for restitutions, and prints what a sphere that hits a plane really does, with and without the cut at zero.

    python examples/restitution_curve.py 0.9 0.5 0.2

The case `damped-wall` states the impact once; each row overrides its restitution. The last columns are closed forms.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import click

from cross_check import engine, reference, suites
from cross_check.compare.quantities import Undefined, restitution
from cross_check.scene import Scene

CASE = suites.FOLDER / "damped_wall.toml"
# Long enough for a heavily damped contact, whose end is late.
LENGTH = "stages.0.end.value=6"


def scene_of(asked: float, steps_per_contact: int) -> Scene:
    """The impact with the dashpot of another restitution, its force cut at zero."""
    overrides = [f"pairs.0.values.damping.value={asked}", f"time.step.steps_per_contact={steps_per_contact}", LENGTH]
    return engine.load_case(CASE, overrides).variants[0].scenes[0].with_model(force_cut="on")


def rebound(scene: Scene) -> str:
    """Rebound over impact speed, or why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        record = engine.run(scene, Path(folder))
    try:
        return f"{restitution(scene, record):.4f}"
    except Undefined as reason:
        return f"({reason})"


def table(asked: list[float], steps_per_contact: int = 1000) -> list[str]:
    """The lines of the table."""
    forms = reference.closed_forms()
    lines = ["asked    cut     uncut   cut, closed form   uncut, closed form"]
    for value in asked:
        cut = scene_of(value, steps_per_contact)
        uncut = cut.with_model(force_cut="off")
        exact = [forms[f"damped_impact.restitution_{name}"](cut) for name in ("cut", "uncut")]
        lines.append(f"{value:<8g} {rebound(cut)}  {rebound(uncut)}  {exact[0]:<16.4f}   {exact[1]:.4f}")
    return lines


if __name__ == "__main__":
    click.echo("\n".join(table([float(word) for word in sys.argv[1:]] or [1.0, 0.9, 0.8, 0.6, 0.4, 0.2])))
