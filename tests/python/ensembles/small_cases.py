"""Small cases that run in milliseconds, and a code that does not exist, for the tests of beds."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import pytest

from cross_check import baseline, engine, reference
from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import Adapter, Deck, RunFailed
from cross_check.engine import Case
from cross_check.record import Code, RunRecord
from cross_check.scene import Scene

HEAD = """
schema = 1
name = "{name}"
question = "Does the harness treat beds as it says?"
level = "L4"
source = "the tests"
geometry = {{ kind = "spheres" }}
gravity = [0, 0, "-9.81 m/s2"]
allow_initial_overlap = true

[domain]
min = [0, 0, "-1 mm"]
max = ["24 mm", "24 mm", "40 mm"]
boundary = ["periodic", "periodic", "open"]

[[materials]]
name = "glass"
young = "5 MPa"
poisson = 0.3
density = "2500 kg/m3"

[[materials]]
name = "wall"
rigid = true

[[pairs]]
between = ["glass", "glass"]
values = {{ damping = {{ kind = "restitution", value = 0.5 }}, friction = 0.5 }}

[[pairs]]
between = ["glass", "wall"]
values = {{ damping = {{ kind = "restitution", value = 0.5 }}, friction = 0.5 }}

[model]
normal = {{ law = "hertz", force_cut = "on" }}
tangential = {{ law = "mindlin", history = "default" }}
moments = {{ law = "free" }}

[[bodies]]
name = "floor"
material = "wall"
shape = {{ kind = "plane", point = [0, 0, 0], normal = [0, 0, 1] }}
motion = {{ kind = "fixed" }}
"""

BED = (
    HEAD.format(name="small-bed")
    + """
[[particles]]
kind = "lattice"
material = "glass"
count = [2, 2, 2]
radius = { kind = "equal", value = "5 mm" }
origin = ["6 mm", "6 mm", "5.5 mm"]
spacing = "11 mm"
noise = "0.4 mm"
velocity = "10 mm/s"

[time]
step = { kind = "fixed", value = "50 us" }

[[stages]]
name = "fall"
end = { kind = "duration", value = "10 ms" }

[[stages]]
name = "later"
end = { kind = "duration", value = "10 ms" }

[[observables]]
name = "packing_fraction"
measure = { kind = "packing_fraction_by_center", floor = "floor" }
stage = "fall"
average = 1

[[observables]]
name = "gain"
measure = { kind = "packing_fraction_by_center", floor = "floor" }
stage = "later"
average = 0
minus = "packing_fraction"

[[gates]]
quantity = "packing_fraction"
check = "equivalence"
scale = "absolute"
bound = 0.05
bound_source = "the tests"

[[gates]]
quantity = "packing_fraction"
check = "equivalence_curve"
scale = "absolute"
bound = 0.05
bound_source = "the tests"

[[gates]]
quantity = "gain"
check = "at_least"
scale = "absolute"
bound = 1e-6
bound_source = "what falls becomes denser"

[ensemble]
seeds = [1, 2, 3]

[output]
every = 20
"""
)

PROFILE = """
[[observables]]
name = "profile"
measure = { kind = "packing_profile", bins = { axis = "z", from = 0, to = "20 mm", width = "5 mm" } }
stage = "later"
average = 1
"""

# A sphere slides on the floor; in the second stage half as much friction holds it.
SLIDE = (
    HEAD.format(name="slide")
    + """
[[particles]]
kind = "single"
material = "glass"
radius = "5 mm"
position = ["12 mm", "12 mm", "4.9915 mm"]
velocity = ["500 mm/s", 0, 0]
angular_velocity = [0, 0, 0]

[time]
step = { kind = "fixed", value = "10 us" }

[[stages]]
name = "rough"
end = { kind = "duration", value = "4 ms" }

[[stages]]
name = "slick"
end = { kind = "duration", value = "4 ms" }

[[stages.actions]]
do = "set_pair"
between = ["wall", "glass"]
values = { friction = 0.25 }

[[observables]]
name = "on_rough"
measure = { kind = "wall_mobilisation", body = "floor", direction = [1, 0, 0] }
stage = "rough"
average = 0.5

[[observables]]
name = "on_slick"
measure = { kind = "wall_mobilisation", body = "floor", direction = [1, 0, 0] }
stage = "slick"
average = 0.5

[output]
every = 20
contacts = true
"""
)


def load(text: str, folder: Path, *overrides: str) -> Case:
    """The case that a text states."""
    path = folder / "case.toml"
    path.write_text(text)
    return engine.load_case(path, list(overrides))


class Fake:
    """A code that computes what the native engine computes, off by `shift` [m] in all heights."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
        """Takes the place of all codes; what is recorded goes into `folder`."""
        self.code: Code | None = Code("fake", "1", "fake 1-1")
        self.shift = 0.0
        self.ran: list[int | None] = []
        # The last first: they come back in the opposite order, which must be the one that they had.
        for name in reversed(list(ADAPTERS)):
            monkeypatch.delitem(ADAPTERS, name)
        adapter = Adapter("fake", ("1", "2"), lambda: self.code, self.deck, lambda scene: scene, self.run)
        monkeypatch.setitem(ADAPTERS, "fake", adapter)
        monkeypatch.setattr(reference, "FOLDER", folder / "reference")
        monkeypatch.setattr(baseline, "FOLDER", folder / "reference")
        monkeypatch.setenv("CROSSGRAIN_CACHE", str(folder / "cache"))

    def deck(self, scene: Scene) -> Deck:
        """A deck that depends on everything that runs."""
        return Deck("fake", scene, {"in.fake": replace(scene, observables=()).to_json()}, "in.fake")

    def run(self, decks: list[Deck], folder: Path, limit: float) -> list[RunRecord | RunFailed]:
        """Runs them natively and moves the particles."""
        assert limit > 0.0
        found: list[RunRecord | RunFailed] = []
        for deck in decks:
            self.ran.append(deck.scene.seed)
            with tempfile.TemporaryDirectory() as scratch:
                record = engine.run(deck.scene, Path(scratch))
            assert self.code is not None
            header = replace(record.header, source="fake", deck_hash=deck.hash, code=self.code)
            moved = record["position"] + [0.0, 0.0, self.shift]
            found.append(RunRecord(header, record.columns | {"position": moved}))
        return found
