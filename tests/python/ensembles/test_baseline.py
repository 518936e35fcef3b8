"""Claims about baselines: what is kept, what is refused, and what a comparison of two of them finds."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from measured_runs import SEEDS, bed, run, with_header

from cross_check import baseline as baselines
from cross_check import report
from cross_check.baseline import Baseline, BaselineError, capture, read, write
from cross_check.compare.changes import (
    BEYOND,
    GONE,
    IDENTICAL,
    NEW,
    UNJUDGED,
    WITHIN,
    BaselineChanges,
    Change,
    compare_baselines,
    trends,
)
from cross_check.ensembles import Ensemble, ensemble
from cross_check.record import RecordError
from cross_check.report.campaign import Campaign

MEASURES = [("packing_fraction", "relax", 0.2), ("coordination", "relax", 0.5)]


def baseline(*ensembles: Ensemble, date: str = "2026-03-01", version: str = "0.1.0") -> Baseline:
    return capture(ensembles or (bed(), bed("yade")), MEASURES, date, version)


def of(changes: BaselineChanges, source: str, observable: str = "packing_fraction") -> Change:
    return next(item for item in changes.changes if (item.source, item.measure.observable) == (source, observable))


def test_a_baseline_comes_back_to_the_bit_and_lies_by_case_date_and_version(tmp_path: Path) -> None:
    made = baseline()
    path = tmp_path / "deep" / "baseline.json"
    write(made, path)
    assert read(path) == made
    assert json.loads(path.read_text())["schema"] == 1
    assert sum('"seed"' in line for line in path.read_text().splitlines()) == 2 * len(SEEDS)
    assert path.stat().st_size < 4000
    assert baselines.path_of(made).parts[-4:] == ("reference", "baselines", "poured-bed", "2026-03-01_0.1.0.json")
    assert baselines.recorded("a case without baselines") == []


def test_recorded_baselines_are_read_from_the_oldest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(baselines, "FOLDER", tmp_path)
    made = [baseline(date=date) for date in ("2026-03-01", "2025-12-24", "2026-01-09")]
    for item in made:
        write(item, baselines.path_of(item))
    assert [item.date for item in baselines.recorded("poured-bed")] == ["2025-12-24", "2026-01-09", "2026-03-01"]


def test_a_baseline_holds_the_values_of_every_seed() -> None:
    entry = next(entry for entry in baseline().entries if entry.source == "yade")
    record = run("yade", 3)
    assert entry.members[2].values == tuple(record.value(*measure) for measure in MEASURES)
    assert entry.members[2].digest == record.digest()
    assert entry.members[2].deck_hash == "deck-yade-3"


def test_baselines_that_cannot_be_made_are_refused() -> None:
    silo = ensemble([with_header(run(seed=seed), case="silo") for seed in SEEDS], SEEDS)
    with pytest.raises(BaselineError, match="the ensembles are of: poured-bed, silo"):
        baseline(bed(), silo)
    with pytest.raises(BaselineError, match="of: none"):
        capture([], MEASURES, "2026-03-01", "0.1.0")
    with pytest.raises(BaselineError, match=r"native of friction=0.5 stands twice"):
        baseline(bed(), bed())
    with pytest.raises(BaselineError, match="date 'yesterday', expected an ISO date"):
        baseline(date="yesterday")
    with pytest.raises(RecordError, match="no observable porosity"):
        capture([bed()], [("porosity", "relax", 0.1)], "2026-03-01", "0.1.0")
    with pytest.raises(BaselineError, match="measures must be there and differ"):
        capture([bed()], MEASURES + MEASURES[:1], "2026-03-01", "0.1.0")


def test_damaged_baselines_are_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "baseline.json"
    write(baseline(), path)
    text = path.read_text()
    value = re.search(r'"values": \[([^,]*),', text)
    assert value is not None
    broken = {
        text.replace('"schema": 1', '"schema": 7'): "schema 7, this version reads schema 1",
        text.replace(value[1], "NaN", 1): r"native of friction=0\.5, seed 1: packing_fraction.* is nan",
        text.replace(value[0], '"values": [', 1): "seed 1: 1 values for 2 measures",
        text.replace('"seed": 2', '"seed": 1', 1): r"seeds \[1, 1, 3, 4, 5\], expected some, each once",
        text.replace('"machine"', '"engine"', 1): "not a readable baseline",
        text[:300]: "not a readable baseline",
    }
    for content, message in broken.items():
        path.write_text(content)
        with pytest.raises(BaselineError, match=f"baseline.json: .*{message}"):
            read(path)
    with pytest.raises(BaselineError, match=r"absent.json: No such file"):
        read(tmp_path / "absent.json")


def test_baselines_of_different_cases_are_refused() -> None:
    silo = ensemble([with_header(run(seed=seed), case="silo") for seed in SEEDS], SEEDS)
    with pytest.raises(BaselineError, match=r"baselines of different cases: poured-bed .* and silo"):
        compare_baselines(baseline(), baseline(silo))
    with pytest.raises(BaselineError, match="baselines of different cases: poured-bed, silo"):
        trends([baseline(), baseline(silo)])


def test_the_same_runs_are_identical() -> None:
    found = compare_baselines(baseline(), baseline(date="2026-04-01"))
    assert found.count(IDENTICAL) == len(found.changes) == 4
    assert found.versions == []
    assert all(change.notes == () for change in found.changes)


def test_another_draw_is_within_scatter_and_a_shift_is_beyond() -> None:
    found = compare_baselines(baseline(), baseline(bed(draw=1), bed("yade", shift=0.03)))
    assert of(found, "native").kind == WITHIN
    assert of(found, "native", "coordination").kind == WITHIN
    shifted = of(found, "yade")
    assert shifted.kind == BEYOND
    assert shifted.interval is not None
    assert shifted.interval[0] < 0.03 < shifted.interval[1]
    assert of(found, "yade", "coordination").kind == IDENTICAL
    assert "5 of 5 measured records changed" in of(found, "yade", "coordination").notes
    assert found.changes[0] == shifted


def test_chance_alone_is_rarely_called_a_change() -> None:
    generator = np.random.default_rng(28)
    alarms = 0
    for _ in range(100):
        old, new = (_many(generator) for _ in range(2))
        alarms += compare_baselines(old, new).count(BEYOND) > 0
    assert alarms <= 5 + 3 * 2.2  # three standard errors above 5 in 100, though each makes ten tests


def _many(generator: np.random.Generator) -> Baseline:
    """Ten sources whose values are drawn from the same distribution."""
    entry = baseline(bed()).entries[0]
    entries = tuple(
        replace(
            entry,
            source=f"source {place}",
            members=tuple(replace(member, values=(float(generator.normal()),)) for member in entry.members),
        )
        for place in range(10)
    )
    return replace(baseline(bed()), measures=baseline(bed()).measures[:1], entries=entries)


def test_sources_and_measures_that_come_and_go_are_named() -> None:
    old = baseline(bed(), bed("yade"))
    new = capture((bed(), bed("liggghts")), MEASURES[:1], "2026-04-01", "0.1.0")
    found = compare_baselines(old, new)
    kinds = {(change.source, change.measure.observable): change.kind for change in found.changes}
    assert kinds == {
        ("native", "packing_fraction"): IDENTICAL,
        ("native", "coordination"): GONE,
        ("yade", "packing_fraction"): GONE,
        ("yade", "coordination"): GONE,
        ("liggghts", "packing_fraction"): NEW,
    }


def test_a_changed_ensemble_of_one_is_not_judged() -> None:
    one, other = (ensemble([run(seed=1, shift=shift)], (1,)) for shift in (0.0, 1e-9))
    found = compare_baselines(baseline(one), baseline(other))
    assert of(found, "native").kind == UNJUDGED
    assert of(found, "native", "coordination").kind == IDENTICAL


def test_fewer_seeds_are_no_identity() -> None:
    few = ensemble([run(seed=seed) for seed in SEEDS[:3]], SEEDS[:3])
    change = of(compare_baselines(baseline(bed()), baseline(few)), "native")
    assert change.kind == WITHIN
    assert change.sizes == (5, 3)
    assert "seeds [1, 2, 3, 4, 5] became [1, 2, 3]" in change.notes


def test_versions_machines_and_decks_that_changed_are_told() -> None:
    members = [with_header(run("yade", seed, version="2024.02"), machine="arm", deck_hash="new") for seed in SEEDS]
    found = compare_baselines(baseline(), baseline(bed(), ensemble(members, SEEDS), version="0.2.0"))
    assert [(item.name, item.old, item.new) for item in found.versions] == [
        ("crossgrain", "0.1.0", "0.2.0"),
        ("yade", "2022.01a (yade package)", "2024.02 (yade package)"),
    ]
    assert of(found, "yade").kind == IDENTICAL
    assert of(found, "yade").notes == (
        "5 of 5 decks changed: the question is another one",
        "yade 2022.01a became yade 2024.02",
        "machine x86_64, 2 cpus became arm",
    )


def test_a_trend_is_in_the_order_of_time_and_keeps_gaps() -> None:
    made = [
        baseline(bed(shift=0.01), bed("yade"), date="2026-03-01"),
        baseline(bed(), date="2026-01-01"),
        baseline(ensemble([run(seed=1)], (1,)), bed("yade"), date="2026-02-01"),
    ]
    found = trends(made)
    assert [trend.measure.observable for trend in found] == ["packing_fraction", "coordination"]
    native, yade = found[0].points["native"], found[0].points["yade"]
    assert [point.date for point in native if point] == ["2026-01-01", "2026-02-01", "2026-03-01"]
    assert yade[0] is None
    first, single, last = native
    assert first is not None
    assert single is not None
    assert last is not None
    assert last.mean - first.mean == pytest.approx(0.01)
    values = bed().values(*MEASURES[0])
    assert first.standard_error == pytest.approx(np.std(values, ddof=1) / np.sqrt(5))
    assert (single.standard_error, single.size) == (None, 1)
    assert trends([]) == []


def test_the_report_tells_what_changed_and_draws_the_trend(tmp_path: Path) -> None:
    old = baseline()
    new = baseline(bed(draw=1), bed("yade", shift=0.03), bed("liggghts"), date="2026-04-01", version="0.2.0 <b>")
    campaign = Campaign("bulk", "today", 1.0, [], [], changes=[compare_baselines(old, new)], trends=trends([old, new]))
    page = report.write(tmp_path, campaign).read_text()
    section = page[page.index('<section id="changes">') : page.index('<section id="left-out">')]
    for words in ("1 changed beyond scatter", "2 changed within scatter", "1 identical", "2 new", "0.2.0 &lt;b&gt;"):
        assert words in section
    assert section.index("≠ changed beyond scatter") < section.index("≈ changed within scatter")
    assert section.count("<svg") == 2
    assert 'href="#changes"' in page
    drawn = sorted(path.suffix for path in (tmp_path / "report" / "figures").iterdir())
    assert drawn == [".pdf", ".pdf", ".svg", ".svg"]


def test_a_report_without_baselines_says_so(tmp_path: Path) -> None:
    page = report.write(tmp_path, Campaign("laws", "today", 1.0, [], [])).read_text()
    assert "No case of this campaign was held against a recorded baseline" in page
