"""A small bed that the native engine runs, for the tests of exported files, with contacts put beside its columns."""

from __future__ import annotations

# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
# numpy leaves the shapes of arrays untyped.
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from cross_check.engine import Case, load_case, run
from cross_check.geometry import facing, nearest
from cross_check.record import Array, RunRecord
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
end = { kind = "duration", value = "80 ms" }

[output]
every = 4000

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
    """A case, its scene, the folder of its record, and the record with contacts."""

    case: Case
    scene: Scene
    folder: Path
    record: RunRecord


def make(folder: Path) -> Bed:
    """Runs the case in `folder`."""
    case = load_case(write_case(folder))
    scene = case.variants[0].scenes[0]
    record = run(scene, folder / "record")
    return Bed(case, scene, folder / "record", with_contacts(scene, record))


def with_contacts(scene: Scene, record: RunRecord) -> RunRecord:
    """The record with every overlap as a contact, by brute force, under forces of a fixed pattern."""
    position, radius = record["position"], np.array(record.header.radius)
    rows: list[tuple[int, int]] = []
    start = [0]
    for sample, time in enumerate(record["time"]):
        for i in range(len(radius)):
            for j in range(i + 1, len(radius)):
                branch = nearest(scene.domain, position[sample, j] - position[sample, i])
                if np.linalg.norm(branch) < radius[i] + radius[j]:
                    rows.append((i, j))
            for number, body in enumerate(scene.bodies):
                velocity = np.array(body.motion.velocity or (0, 0, 0))
                _, distance = facing(body.shape, position[sample, i : i + 1] - velocity * time)
                if distance[0] < radius[i]:
                    rows.append((i, len(radius) + number))
        start.append(len(rows))
    force: Array = np.random.default_rng(5).normal(size=(len(rows), 3))
    columns = {
        "contact_start": np.array(start, dtype=np.int64),
        "contact_pair": np.array(rows, dtype=np.int64).reshape(-1, 2),
        "contact_force": force,
    }
    return replace(record, columns=record.columns | columns)
