"""Claims about the check `matched`: two codes under different laws that a closed form makes alike."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cross_check import engine, reference
from cross_check.compare.ensemble_checks import Bed, compare_ensembles
from cross_check.compare.outcome import Outcome
from cross_check.compare.quantity import UnknownQuantity
from cross_check.compare.verdicts import AGREE, DIFFER, INCONCLUSIVE, Comparison, not_run
from cross_check.contact_model import AreaCohesion
from cross_check.engine import Case, Gate, Matched, MatchedSide
from cross_check.measured import Measured
from cross_check.record import Array, Code, Header
from cross_check.scene import Scene

SCATTER = np.array([-1.0, 0.0, 1.0])  # standard deviation 1
SIDES = Matched(MatchedSide("liggghts", "sjkr"), MatchedSide("yade", "dmt"))
CODES = ("liggghts", "yade")
VALUES = {"liggghts": 0.5 + 0.001 * SCATTER, "yade": 0.5 + 0.001 * SCATTER}


@pytest.fixture(scope="module")
def case() -> Case:
    return engine.load_case(Path(__file__).parents[3] / "cross_check/cases/cohesive_bed.toml")


def measured(scene: Scene, source: str, value: float) -> Measured:
    header = Header(
        source, scene.case, scene.variant, scene.seed, 0, Code(source, "1", "test"), "", "here", 1.0, 1e-4, 1,
        "synchronized", "exact", [1.0], [1.0], [], [0.0, 0.0, 0.0],
    )  # fmt: skip
    series: dict[str, Array] = {"packing_fraction": np.full(4, value)}
    return Measured(
        header, np.arange(4.0), np.array([0, 0, 1, 1]), ("settle", "rest"), series, {"packing_fraction": "-"}
    )


def alike(scene: Scene, density: float) -> Scene:
    """The scene with another energy density, where its law has one."""
    normal = scene.model.normal
    if not isinstance(normal, AreaCohesion):
        return scene
    return replace(scene, model=replace(scene.model, normal=replace(normal, energy_density=density)))


def judged(
    case: Case,
    bound: float = 0.01,
    scale: str = "absolute",
    sides: Matched = SIDES,
    codes: tuple[str, ...] = CODES,
    law_form: str = "pull_off.largest_attraction",
    values: dict[str, Array] = VALUES,
    missing: str = "",
) -> list[Comparison]:
    """The comparisons of both variants of three seeds; `missing` is a code that did not run."""
    density = 154.855e3  # [J/m3] that gives the pull-off force of the case under DMT to 5e-5
    gate = Gate("packing_fraction", "matched", law_form, scale, bound, "the test", None, sides)
    found: list[Bed] = []
    for law in ("dmt", "sjkr"):
        scenes = tuple(v.scenes[0] for v in case.variants if v.name == f"{law},quick")[:3]
        scenes = tuple(alike(scene, density) for scene in scenes)
        outcomes = tuple(
            {
                (code, 0): Outcome(code, scene, None, not_run("crashed"))
                if code == missing
                else Outcome(code, scene, None, measured=measured(scene, code, float(values[code][place])))
                for code in CODES
            }
            for place, scene in enumerate(scenes)
        )
        found.append(Bed(case.name, f"{law},quick", (gate,), scenes, outcomes, codes))
    whole = tuple(found)
    return [item for bed in found for item in compare_ensembles(replace(bed, siblings=whole))]


@pytest.mark.parametrize(
    ("shift", "deviation", "verdict"),
    [(0.002, 0.001, AGREE), (0.03, 0.001, DIFFER), (0.0, 0.02, INCONCLUSIVE)],
)
def test_a_matched_pair_is_judged_once_by_its_means(case: Case, shift: float, deviation: float, verdict: str) -> None:
    values = {"liggghts": 0.5 + shift + deviation * SCATTER, "yade": 0.5 + deviation * SCATTER}
    (found,) = judged(case, values=values)
    assert found.verdict == verdict
    assert (found.left.source, found.right.source) == ("liggghts (sjkr)", "yade (dmt)")
    assert found.case == "cohesive-bed/sjkr,quick"
    assert found.discrepancy == pytest.approx(shift, abs=1e-12)
    assert found.note.startswith("matched by pull_off.largest_attraction ")


def test_laws_that_the_closed_form_does_not_make_alike_are_not_comparable(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    def half(scene: Scene) -> float:
        return 1.0 if scene.variant.startswith("dmt") else 0.995

    monkeypatch.setitem(reference.closed_forms(), "half", half)
    (found,) = judged(case, law_form="half")
    assert found.verdict == "not-comparable(the laws are not made alike: half 0.995 and 1)"


def test_the_pull_off_forces_of_the_cohesive_bed_are_alike_to_a_thousandth(case: Case) -> None:
    form = reference.closed_forms()["pull_off.largest_attraction"]
    dmt, sjkr = (next(v.scenes[0] for v in case.variants if v.name == name) for name in ("dmt,quick", "sjkr,quick"))
    pulls = [form(replace(scene, particles=scene.particles[:2])) for scene in (dmt, sjkr)]
    assert pulls[0] == pytest.approx(pulls[1], rel=1e-3)


def test_a_side_that_did_not_run_leaves_no_verdict(case: Case) -> None:
    (found,) = judged(case, missing="yade")
    assert found.verdict == "not-run(crashed)"


def test_codes_that_were_not_asked_for_are_not_compared(case: Case) -> None:
    assert judged(case, codes=("yade",)) == []


def test_the_discrepancy_of_a_relative_margin_is_relative(case: Case) -> None:
    values = {"liggghts": 0.5 + 0.001 * SCATTER, "yade": 0.505 + 0.001 * SCATTER}
    (found,) = judged(case, 0.02, "relative", values=values)
    assert found.discrepancy == pytest.approx(0.01)


def test_a_closed_form_that_does_not_exist_is_told(case: Case) -> None:
    with pytest.raises(UnknownQuantity, match="no closed form pull_off"):
        judged(case, law_form="pull_off.no_such_form")
