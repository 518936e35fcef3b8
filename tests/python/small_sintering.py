"""The sintering cases of the package, shortened: a run of milliseconds in place of a second."""

from __future__ import annotations

import re
from pathlib import Path

from cross_check import PACKAGE

CASES = PACKAGE / "cases"
# A fifteenth of the shortest contact, ten times that of the cases.
STEP = 3e-6
GATE = """
[[gates]]
quantity = "force_history"
check = "mirror"
scale = "peak"
bound = 1e-9
bound_source = "rounding"
"""


def shorten(name: str, folder: Path, steps: dict[str, int], every: int, gate: str = "") -> Path:
    """The first variant of a case, written into `folder`, whose stages last other numbers of steps."""
    text = (CASES / name).read_text()
    for stage, count in steps.items():
        pattern = rf'(name = "{stage}"\nend = {{ kind = "duration", value = )"[^"]*"'
        text, found = re.subn(pattern, rf'\1"{count * STEP:.9g} s"', text)
        assert found == 1, f"{name} has no stage {stage}"
    assert text.count('value = "3e-7 s"') == 1
    text = text.replace('value = "3e-7 s"', f'value = "{STEP:g} s"')
    text, found = re.subn(r"\nevery = \d+", f"\nevery = {every}", text)
    assert found == 1
    # One variant: what the file states by itself.
    text = re.sub(r"\[\[vary\]\].*?(?=\[ensemble\])", "", text, flags=re.DOTALL)
    path = folder / name
    path.write_text(text + gate)
    return path


def three(folder: Path, gate: str = "") -> Path:
    """Three disks that are pressed, heated, sintered and cooled; `sinter` is sampled twice as often."""
    stages = {"press": 20000, "heat": 1000, "sinter": 1000, "cool": 1000, "relax": 1000}
    path = shorten("sintering_three.toml", folder, stages, 500, gate)
    text = path.read_text()
    before = 'actions = [{ do = "set_relaxation_time", value = "0.1 s" }]\n'
    assert text.count(before) == 1
    path.write_text(text.replace(before, f"{before}output = {{ every = 250 }}\n"))
    return path


def chain(folder: Path, gate: str = "") -> Path:
    """A box of 100 disks of which cooling branches off, and after that compression: 1,000, 300 and 200 steps."""
    shorten("sintering_box.toml", folder, {"press": 400, "heat": 300, "sinter": 300}, 100)
    cooled = shorten("sintering_cooled.toml", folder, {"cool": 200, "relax": 100}, 50)
    text = cooled.read_text()
    assert text.count('at = "1 s"') == 1
    cooled.write_text(text.replace('at = "1 s"', f'at = "{150 * STEP:.9g} s"'))
    return shorten("sintering_compression.toml", folder, {"compress": 200}, 50, gate)
