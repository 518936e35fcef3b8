"""Claims about the checks that judge ensembles, on made-up measured records."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_cases import BED, load

from cross_check import engine, reference
from cross_check.adapters.interface import Deck
from cross_check.compare.ensemble_checks import BOUND, DETERMINISTIC, Bed, beds, compare_ensembles
from cross_check.compare.outcome import NATIVE, Outcome, Outcomes
from cross_check.compare.verdicts import AGREE, DIFFER, INCONCLUSIVE, Comparison, kind, not_run
from cross_check.engine import Case, Gate
from cross_check.measured import Measured
from cross_check.record import Array, Code, Header
from cross_check.scene import Scene
from cross_check.suites import with_seeds

SEEDS = (1, 2, 3, 4, 5)
# One value per seed, mean 0, standard deviation 1.
SCATTER = np.array([-1.2649110640673518, -0.6324555320336759, 0.0, 0.6324555320336759, 1.2649110640673518])
TIME = np.arange(20.0) * 0.01


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    return load(BED, tmp_path_factory.mktemp("bed")).variants[0].scenes[0]


def stated(name: str, minus: str | None = None, average: float = 1.0, stage: str = "later") -> dict[str, Any]:
    measure = {"kind": "packing_fraction_by_center", "floor": "floor"}
    return {"name": name, "measure": measure, "stage": stage, "average": average, "minus": minus}


def measured(
    scene: Scene, source: str, series: dict[str, Array], machine: str = "here", version: str = "1"
) -> Measured:
    """What was measured of a run of two stages, ten samples each."""
    header = Header(
        source, scene.case, scene.variant, scene.seed, 0, Code(source, version, "test"), f"deck-{scene.seed}", machine,
        1.0, scene.time_step, scene.steps, "synchronized", "exact", [1.0], [1.0], ["floor"], [0.0, 0.0, -9.81],
    )  # fmt: skip
    stage = np.repeat([0, 1], [10, 10])
    return Measured(header, TIME, stage, ("fall", "later"), series, dict.fromkeys(series, "-"))


Values = Callable[[str, int], Array]
"""The series of an observable by the name of the source and the place of the seed, shape (20,)."""


def bed(
    scene: Scene, gate: Gate, values: dict[str, Values], seeds: tuple[int, ...] = SEEDS, minus: str | None = None
) -> Bed:
    """A bed of native and one code, `lammps`; observables that are not the gate's only serve `minus`."""
    observables = tuple(stated(name, minus if name == gate.quantity else None) for name in values)
    scenes = tuple(replace(scene, seed=seed, observables=observables) for seed in seeds)
    outcomes: list[Outcomes] = []
    for place, one in enumerate(scenes):
        found: Outcomes = {}
        for source in (NATIVE, "lammps"):
            series = {name: value(source, place) for name, value in values.items()}
            found[source, 0] = Outcome(source, one, None, measured=measured(one, source, series))
        outcomes.append(found)
    return Bed(scene.case, "", (gate,), scenes, tuple(outcomes), ("lammps",))


def gate(check: str, bound: float, quantity: str = "it", scale: str = "absolute") -> Gate:
    return Gate(quantity, check, None, scale, bound, "the test", None)


def apart(difference: float, deviation: float, mean: float = 10.0) -> Values:
    """Ensembles of one standard deviation whose means are `difference` apart, constant in time."""

    def value(source: str, place: int) -> Array:
        shift = 0.0 if source == NATIVE else difference
        return np.full(20, mean + shift + deviation * SCATTER[place])

    return value


def only(found: Bed) -> Comparison:
    (comparison,) = compare_ensembles(found)
    return comparison


@pytest.mark.parametrize(
    ("difference", "deviation", "verdict"),
    [
        (0.05, 0.02, AGREE),
        (-0.05, 0.02, AGREE),
        (0.3, 0.02, DIFFER),
        (-0.3, 0.02, DIFFER),
        (0.0, 0.3, INCONCLUSIVE),
        (0.1, 0.02, INCONCLUSIVE),
    ],
)
@pytest.mark.parametrize("check", ["equivalence", "equivalence_curve"])
def test_means_are_judged_by_their_margin_and_scatter(
    scene: Scene, check: str, difference: float, deviation: float, verdict: str
) -> None:
    found = only(bed(scene, gate(check, 0.1), {"it": apart(difference, deviation)}))
    assert found.verdict == verdict
    assert found.discrepancy == pytest.approx(abs(difference), abs=1e-12)
    assert (found.left.source, found.right.source) == (NATIVE, "lammps")
    assert found.left.value == pytest.approx(10.0)
    assert found.left.uncertainty_kind == "ensemble"
    assert "power" in found.note
    assert "margin 0.1" in found.note


def test_the_uncertainty_of_a_mean_is_its_standard_error(scene: Scene) -> None:
    found = only(bed(scene, gate("equivalence", 0.1), {"it": apart(0.0, 0.02)}))
    assert found.left.uncertainty == pytest.approx(0.02 / np.sqrt(5))
    assert "n 5" in found.note


def test_a_relative_margin_is_a_share_of_the_mean_of_native(scene: Scene) -> None:
    found = only(bed(scene, gate("equivalence", 0.02, scale="relative"), {"it": apart(0.15, 0.02)}))
    assert found.verdict == AGREE
    assert found.discrepancy == pytest.approx(0.015)
    assert "margin 0.2" in found.note
    assert only(bed(scene, gate("equivalence", 0.01, scale="relative"), {"it": apart(0.15, 0.02)})).verdict == DIFFER


def test_curves_that_meet_at_their_ends_only_differ(scene: Scene) -> None:
    def value(source: str, place: int) -> Array:
        hump = np.sin(np.pi * np.arange(20) / 19) if source == "lammps" else np.zeros(20)
        return 1.0 + 0.01 * SCATTER[place] + hump

    curve = only(bed(scene, gate("equivalence_curve", 0.3), {"it": value}))
    assert curve.verdict == DIFFER
    assert curve.discrepancy == pytest.approx(np.sin(np.pi * 9 / 19))
    last = bed(scene, gate("equivalence", 0.3), {"it": value})
    ends = tuple(replace(one, observables=(stated("it", average=0.0),)) for one in last.scenes)
    assert only(replace(last, scenes=ends)).verdict == AGREE


def test_lists_of_numbers_have_no_curve(scene: Scene) -> None:
    found = only(bed(scene, gate("equivalence_curve", 0.3), {"it": lambda source, place: np.ones((20, 4))}))
    assert found.verdict == "not-comparable(it is not one number at each time)"


def test_bounds_hold_for_the_worst_seed_of_every_source(scene: Scene) -> None:
    values = {"it": apart(0.5, 1.0, mean=3.0)}
    most, least = 3.0 + SCATTER[-1], 3.0 + SCATTER[0]
    native, lammps = compare_ensembles(bed(scene, gate("at_most", most + 0.1), values))
    assert (native.verdict, lammps.verdict) == (AGREE, DIFFER)
    assert (native.left.value, lammps.left.value) == pytest.approx((most, most + 0.5))
    assert (native.discrepancy, lammps.discrepancy) == pytest.approx((0.0, 0.4))
    assert (native.right.source, native.right.value) == (BOUND, most + 0.1)
    assert native.note == "largest of 5 seeds, mean 3"
    native, lammps = compare_ensembles(bed(scene, gate("at_least", least + 0.1), values))
    assert (native.verdict, lammps.verdict) == (DIFFER, AGREE)
    assert native.discrepancy == pytest.approx(0.1)
    assert native.note.startswith("smallest of 5 seeds")


def test_one_bad_seed_is_enough(scene: Scene) -> None:
    def value(source: str, place: int) -> Array:
        return np.full(20, 2.0 if (source, place) == ("lammps", 3) else 0.0)

    verdicts = [item.verdict for item in compare_ensembles(bed(scene, gate("at_most", 1.0), {"it": value}))]
    assert verdicts == [AGREE, DIFFER]


def test_an_ensemble_of_one_is_not_comparable(scene: Scene) -> None:
    for check in ("equivalence", "equivalence_curve"):
        found = only(bed(scene, gate(check, 0.1), {"it": apart(0.0, 0.02)}, seeds=(1,)))
        assert found.verdict == "not-comparable(an ensemble of one has no scatter)"
        assert found.discrepancy is None
    # A bound needs no scatter.
    found = list(compare_ensembles(bed(scene, gate("at_most", 20.0), {"it": apart(0.0, 0.02)}, seeds=(1,))))
    assert [item.verdict for item in found] == [AGREE, AGREE]
    assert found[0].note == "largest of 1 seeds"


def with_outcome(found: Bed, place: int, source: str, **changes: Any) -> Bed:
    """The bed with another outcome of one seed of a source."""
    outcomes = list(found.outcomes)
    outcomes[place] = outcomes[place] | {(source, 0): replace(outcomes[place][source, 0], **changes)}
    return replace(found, outcomes=tuple(outcomes))


def test_seeds_that_differ_between_codes_are_not_comparable(scene: Scene) -> None:
    whole = bed(scene, gate("equivalence", 0.1), {"it": apart(0.0, 0.02)})
    fourth = whole.outcomes[3]["lammps", 0].measured
    assert fourth is not None
    other = replace(fourth, header=replace(fourth.header, seed=7))
    found = only(with_outcome(whole, 3, "lammps", measured=other))
    assert found.verdict == "not-comparable(lammps of small-bed/: no record for the seeds 4 (there: 1, 2, 3, 5, 7))"
    twice = replace(fourth, header=replace(fourth.header, seed=5))
    assert "two records have this seed" in only(with_outcome(whole, 3, "lammps", measured=twice)).verdict


def test_two_versions_of_a_code_make_no_ensemble(scene: Scene) -> None:
    whole = bed(scene, gate("equivalence", 0.1), {"it": apart(0.0, 0.02)})
    fourth = whole.outcomes[3]["lammps", 0].measured
    assert fourth is not None
    newer = replace(fourth, header=replace(fourth.header, code=Code("lammps", "2", "test")))
    found = only(with_outcome(whole, 3, "lammps", measured=newer))
    assert found.verdict.startswith("not-comparable(an ensemble of different runs: lammps (lammps 1)")


def test_a_seed_that_did_not_run_leaves_no_verdict(scene: Scene) -> None:
    whole = bed(scene, gate("equivalence", 0.1), {"it": apart(0.0, 0.02)})
    found = only(with_outcome(whole, 2, "lammps", measured=None, verdict=not_run("out of time"), origin="not run"))
    assert found.verdict == "not-run(out of time)"
    native, lammps = compare_ensembles(
        with_outcome(
            replace(whole, gates=(gate("at_most", 20.0),)), 2, "lammps", measured=None, verdict=not_run("out of time")
        )
    )
    assert (native.verdict, lammps.verdict) == (AGREE, "not-run(out of time)")


def test_a_value_that_is_not_defined_is_not_comparable(scene: Scene) -> None:
    def value(source: str, place: int) -> Array:
        return np.full(20, np.nan if (source, place) == ("lammps", 1) else 1.0 + place)

    for check in ("equivalence", "equivalence_curve"):
        found = only(bed(scene, gate(check, 0.1), {"it": value}))
        assert kind(found.verdict) == "not-comparable"
    assert (
        "seed=2: it is not defined in all of the last 10 samples of later"
        in only(bed(scene, gate("equivalence", 0.1), {"it": value})).verdict
    )


def test_another_observable_is_subtracted_seed_by_seed(scene: Scene) -> None:
    common = 5.0 * SCATTER

    def before(source: str, place: int) -> Array:
        return np.full(20, common[place])

    def after(source: str, place: int) -> Array:
        return np.full(20, common[place] + (0.4 if source == NATIVE else 0.2) + 0.01 * SCATTER[place])

    values = {"before": before, "it": after}
    gain = bed(scene, gate("at_least", 0.3), values, minus="before")
    assert gain.values(NATIVE, "it") == pytest.approx(0.4 + 0.01 * SCATTER)
    assert [item.verdict for item in compare_ensembles(gain)] == [AGREE, DIFFER]
    # The scatter that both have in common is gone: the means of the differences are told apart.
    assert only(bed(scene, gate("equivalence", 0.1), values, minus="before")).verdict == DIFFER
    assert only(bed(scene, gate("equivalence", 0.1), values)).verdict == INCONCLUSIVE


def test_an_average_of_nothing_is_the_last_sample(scene: Scene) -> None:
    found = bed(scene, gate("at_most", 1.0), {"it": lambda source, place: np.arange(20.0)})
    scenes = tuple(replace(one, observables=(stated("it", average=0.0),)) for one in found.scenes)
    assert replace(found, scenes=scenes).values(NATIVE, "it").tolist() == [19.0] * 5
    first = tuple(replace(one, observables=(stated("it", average=0.5, stage="fall"),)) for one in found.scenes)
    assert replace(found, scenes=first).values(NATIVE, "it").tolist() == [7.0] * 5


@pytest.fixture
def repeated(scene: Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., list[Comparison]]:
    """Compares a run with the recorded one, whose series and header may be other ones."""
    monkeypatch.setattr(reference, "FOLDER", tmp_path)

    def compared(then: dict[str, Array], now: dict[str, Array], **header: object) -> list[Comparison]:
        one = replace(scene, seed=1, observables=tuple(stated(name) for name in now))
        deck = Deck("lammps", one, {"in": "a deck"}, "in")
        fresh = measured(one, "lammps", now)
        fresh = replace(fresh, header=replace(fresh.header, deck_hash=deck.hash))
        recorded = replace(measured(one, "lammps", then), header=replace(fresh.header, **header))
        place = reference._measured_folder("lammps", "1", deck.hash, one)  # pyright: ignore[reportPrivateUsage]
        recorded.write(place)
        outcome = Outcome("lammps", one, None, deck=deck, measured=fresh)
        return list(compare_ensembles(Bed(one.case, "", (), (one,), ({("lammps", 0): outcome},), ("lammps",))))

    return compared


def test_a_run_repeats_the_recorded_one_to_the_bit_on_its_machine(
    repeated: Callable[..., list[Comparison]],
) -> None:
    series = np.sin(TIME)
    (found,) = repeated({"it": series}, {"it": series})
    assert (found.check, found.verdict, found.discrepancy, found.bound) == ("recorded", AGREE, 0.0, 0.0)
    assert found.left.recorded
    assert not found.right.recorded
    moved = np.array(series)
    moved[-1] = np.nextafter(moved[-1], 9.0)
    (found,) = repeated({"it": series}, {"it": moved})
    assert found.verdict == DIFFER
    assert found.discrepancy is not None
    assert 0.0 < found.discrepancy < 1e-14


def test_another_machine_repeats_the_deterministic_window(repeated: Callable[..., list[Comparison]]) -> None:
    series = np.sin(TIME)
    late = np.where(TIME > DETERMINISTIC, series + 0.1, series + 1e-9)
    (found,) = repeated({"it": series}, {"it": late}, machine="there")
    assert found.verdict == AGREE
    assert found.discrepancy is not None
    assert 0.0 < found.discrepancy <= 1e-6
    assert "recorded on there" in found.note
    early = np.where(TIME > DETERMINISTIC, series, series + 1e-4)
    assert repeated({"it": series}, {"it": early}, machine="there")[0].verdict == DIFFER


def test_a_value_that_is_defined_in_one_of_them_only_differs(repeated: Callable[..., list[Comparison]]) -> None:
    gone = np.where(TIME == 0.0, np.nan, TIME)
    (found,) = repeated({"it": TIME}, {"it": gone})
    assert (found.verdict, found.discrepancy) == (DIFFER, np.inf)
    assert repeated({"it": gone}, {"it": gone})[0].verdict == AGREE


def test_another_version_is_not_held_against_the_recorded_run(repeated: Callable[..., list[Comparison]]) -> None:
    assert repeated({"it": TIME}, {"it": TIME + 1.0}, code=Code("lammps", "2", "test")) == []


def test_the_first_seeds_are_those_of_every_variant(tmp_path: Path) -> None:
    sweep = (
        '\n[[vary]]\naxis = "height"\npoints = [{ label = "low" }, { label = "high", set = '
        '{ "particles.0.origin.2" = "7 mm", "ensemble.seeds" = [3, 1] } }]\n'
    ).replace('label = "low" }', 'label = "low", set = { "particles.0.origin.2" = "5.5 mm" } }')
    case = load(BED + sweep, tmp_path)

    def kept(found: Case) -> list[tuple[str, int | None]]:
        return [(variant.name, variant.scenes[0].seed) for variant in found.variants]

    assert kept(case) == [("low", 1), ("low", 2), ("low", 3), ("high", 3), ("high", 1)]
    assert kept(with_seeds(case, 1)) == [("low", 1), ("high", 3)]
    assert kept(with_seeds(case, 2)) == [("low", 1), ("low", 2), ("high", 3), ("high", 1)]
    assert kept(with_seeds(case, 9)) == kept(case)
    assert [found.name for found in beds(case, {s.name: {} for v in case.variants for s in v.scenes}, ())] == [
        "small-bed/low",
        "small-bed/high",
    ]


def test_a_case_without_seeds_keeps_its_variants() -> None:
    case = engine.load_case(Path(__file__).parents[3] / "cross_check/cases/damped_wall.toml")
    assert with_seeds(case, 1) == case
