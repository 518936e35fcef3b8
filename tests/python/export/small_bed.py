"""A small bed that the native engine runs, for the tests of exported files."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from cross_check.engine import Case, load_case, run
from cross_check.record import RunRecord
from cross_check.scene import Scene

CASE = """
schema = 1
name = "small-bed"
question = "Do exported files hold what the record holds?"
level = "L1"
source = "a bed between two planes in a periodic box"
geometry = { kind = "spheres" }
gravity = [0, 0, "-9.81 m/s2"]

[domain]
min = ["-5 mm", "-5 mm", "0 mm"]
max = ["5 mm", "5 mm", "20 mm"]
boundary = ["periodic", "open", "open"]

[[materials]]
name = "glass"
young = "10 MPa"
poisson = 0.25
density = "2500 kg/m3"

[[materials]]
name = "steel"
young = "50 MPa"
poisson = 0.3
density = "7800 kg/m3"

[[materials]]
name = "wall"
rigid = true

@PAIRS@
[model]
normal = { law = "hertz", force_cut = "on" }
tangential = { law = "mindlin", history = "force_rescaled" }
moments = { law = "free" }

[[bodies]]
name = "floor"
material = "wall"
shape = { kind = "plane", point = [0, 0, 0], normal = [0, 0, 1] }
motion = { kind = "fixed" }

[[bodies]]
name = "sliding"
material = "wall"
shape = { kind = "plane", point = [0, "-5 mm", 0], normal = [0, 1, 0] }
motion = { kind = "prescribed", velocity = [0, "0.1 m/s", 0] }

[[bodies]]
name = "pipe"
material = "wall"
shape = { kind = "cylinder", point = [0, 0, "10 mm"], axis = [1, 0, 0], radius = "10 mm" }
motion = { kind = "fixed" }

[[particles]]
kind = "random"
material = "glass"
count = 24
radius = { kind = "uniform", min = "0.8 mm", max = "1.2 mm" }
region = [["-5 mm", "-3 mm", "1 mm"], ["5 mm", "4 mm", "8 mm"]]
velocity = "300 mm/s"

[[particles]]
kind = "single"
material = "steel"
radius = "1 mm"
position = ["4.9 mm", 0, "9.5 mm"]
velocity = ["500 mm/s", 0, 0]
angular_velocity = [0, 0, 0]

[ensemble]
seeds = [7]

[time]
step = { kind = "fixed", value = "2e-6 s" }

[[stages]]
name = "fall"
end = { kind = "duration", value = "40 ms" }

[[stages]]
name = "stop"
end = { kind = "duration", value = "40 ms" }
actions = [{ do = "set_motion", body = "sliding", motion = { kind = "prescribed", velocity = [0, 0, "0.2 m/s"] } }]

[output]
every = 4000
contacts = true

[[gates]]
quantity = "position_history"
check = "mirror"
scale = "peak"
bound = 1e-9
bound_source = "rounding"
"""
PAIR = """
[[pairs]]
between = ["{}", "{}"]
values = {{ damping = {{ kind = "restitution", value = 0.6 }}, friction = 0.5 }}
"""


def write_case(folder: Path) -> Path:
    """The case as a file."""
    names = [("glass", "glass"), ("glass", "steel"), ("steel", "steel"), ("glass", "wall"), ("steel", "wall")]
    path = folder / "small-bed.toml"
    path.write_text(CASE.replace("@PAIRS@", "\n".join(PAIR.format(*pair) for pair in names)))
    return path


@dataclass(frozen=True)
class Bed:
    """A case, its scene, and the folder of its record with the record in it."""

    case: Case
    scene: Scene
    folder: Path
    record: RunRecord


def make(folder: Path) -> Bed:
    """Runs the case in `folder`."""
    case = load_case(write_case(folder))
    scene = case.variants[0].scenes[0]
    return Bed(case, scene, folder / "record", run(scene, folder / "record"))


def without_contacts(record: RunRecord) -> RunRecord:
    """The record as one that tells no contacts."""
    columns = {name: column for name, column in record.columns.items() if not name.startswith("contact_")}
    return replace(record, columns=columns)
