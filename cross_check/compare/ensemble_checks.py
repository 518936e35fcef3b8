"""The checks of a gate that judges ensembles: beds of several seeds, by the observables of their case."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cross_check import reference
from cross_check.compare.curve_ensembles import aligned, compare_curves
from cross_check.compare.equivalence import equivalence
from cross_check.compare.outcome import NATIVE, Outcome, Outcomes
from cross_check.compare.quantity import Undefined, UnknownQuantity
from cross_check.compare.samples import BadSample, sample
from cross_check.compare.verdicts import AGREE, DIFFER, FULL_ONLY, Comparison, Side, not_comparable
from cross_check.engine import Case, Gate
from cross_check.ensembles import Ensemble, ensemble
from cross_check.measured import read as read_measured
from cross_check.record import Array, RecordError
from cross_check.scene import Scene

BOUND = "bound"
# The smallest share of a stage: its last sample.
LAST = 1e-12
# Relative difference up to which a closed form makes two laws alike: a value of a case has four digits.
ALIKE = 2e-3
# Time [s] within which another machine repeats a recorded bed, and how well: particles fall and begin to touch.
DETERMINISTIC = 0.05
SAME = 1e-6


@dataclass(frozen=True)
class Bed:
    """One variant of a case with all its seeds: scenes and outcomes in the order of the seeds, one for each.

    `full`: only the full form of a suite runs it. `siblings` are all variants of the case.
    """

    case: str
    variant: str
    gates: tuple[Gate, ...]
    scenes: tuple[Scene, ...]
    outcomes: tuple[Outcomes, ...]
    codes: tuple[str, ...]
    full: bool = False
    siblings: tuple[Bed, ...] = ()

    @property
    def name(self) -> str:
        """`case/variant`."""
        return f"{self.case}/{self.variant}" if self.variant else self.case

    def of(self, source: str) -> list[Outcome]:
        """The outcomes of a source, one for each seed."""
        return [outcomes[source, 0] for outcomes in self.outcomes]

    def ensemble(self, source: str) -> Ensemble:
        """The ensemble of a source, by the observables that are one number at each time, which recorded runs have too.

        Raises Undefined with the verdict of the first seed that has no record.
        """
        outcomes = self.of(source)
        missing = next((item.verdict for item in outcomes if item.measured is None), None)
        if missing is not None:
            raise Undefined(missing)
        members = [item.measured.scalars() for item in outcomes if item.measured is not None]
        seeds = [seed for scene in self.scenes if (seed := scene.seed) is not None]
        try:
            return ensemble(members, seeds)
        except RecordError as error:
            raise Undefined(str(error)) from error

    def recorded(self, source: str) -> bool:
        """Whether a stored run stands in for any of a source."""
        return source != BOUND and any(item.origin == "recorded" for item in self.of(source))

    def observable(self, name: str) -> dict[str, Any]:
        """What the case says about an observable: `name`, `measure`, `stage`, `average`, `minus`."""
        return next(item for item in self.scenes[0].observables if item["name"] == name)

    def values(self, source: str, name: str) -> Array:
        """An observable of every seed, shape (n,). Raises Undefined."""
        members = self.ensemble(source)
        stated = self.observable(name)
        try:
            found = members.values(name, stated["stage"], max(float(stated["average"]), LAST))
        except RecordError as error:
            raise Undefined(str(error)) from error
        return found if stated.get("minus") is None else found - self.values(source, stated["minus"])

    def unit(self, name: str) -> str:
        """The unit of an observable, by the first record that there is."""
        records = (item.measured for outcomes in self.outcomes for item in outcomes.values())
        return next((record.units[name] for record in records if record is not None and name in record.units), "-")


def beds(case: Case, results: dict[str, Outcomes], codes: tuple[str, ...]) -> list[Bed]:
    """The variants of a case whose ensembles are judged."""
    names = dict.fromkeys(variant.name for variant in case.variants)
    found: list[Bed] = []
    for name in names:
        members = [variant for variant in case.variants if variant.name == name]
        gates = tuple(gate for gate in members[0].gates if gate.check in ENSEMBLE_CHECKS)
        if gates:
            scenes = tuple(variant.scenes[0] for variant in members)
            outcomes = tuple(results[scene.name] for scene in scenes)
            found.append(Bed(case.name, name, gates, scenes, outcomes, codes, members[0].full_only))
    return [replace(bed, siblings=tuple(found)) for bed in found]


def compare_ensembles(bed: Bed) -> Iterator[Comparison]:
    """All comparisons of all gates of a bed, and of what is recorded with what ran now."""
    for gate in bed.gates:
        if gate.full_only and not bed.full:
            for code in bed.codes:
                yield _comparison(bed, gate, Side(NATIVE, None, None), Side(code, None, None), None, FULL_ONLY)
        else:
            yield from ENSEMBLE_CHECKS[gate.check](bed, gate)
    for code in bed.codes:
        yield from _as_recorded(bed, code)


def _as_recorded(bed: Bed, code: str) -> Iterator[Comparison]:
    """What ran now of a code against the recorded run of the same deck and version: nothing where there is none.

    On the machine that recorded it every number is the same; elsewhere it is in the deterministic window, before the
    rounding of another processor has grown.
    """
    outcome = next((item for item in bed.of(code) if item.origin in ("live", "cache")), None)
    if outcome is None or outcome.measured is None or outcome.deck is None:
        return
    folder = reference.recorded_measured(code, outcome.deck.hash, outcome.scene)
    if folder is None:
        return
    then, now = read_measured(folder), outcome.measured
    if then.header.code.version != now.header.code.version:
        return
    same_machine = then.header.machine == now.header.machine
    chosen = slice(None) if same_machine else now.time <= DETERMINISTIC
    differences = [_unequal(then[name][chosen], now[name][chosen]) for name in then.series]
    discrepancy = max(differences, default=0.0)
    bound = 0.0 if same_machine else SAME
    yield Comparison(
        case=outcome.scene.name,
        level=outcome.scene.level,
        check="recorded",
        quantity="observables",
        unit="-",
        left=Side(f"{code} as recorded", None, None, recorded=True),
        right=Side(code, None, None),
        discrepancy=discrepancy,
        scale="range",
        bound=bound,
        bound_source="the same machine and version repeat every number"
        if same_machine
        else f"another machine repeats the first {DETERMINISTIC} s, before rounding has grown",
        verdict=AGREE if discrepancy <= bound else DIFFER,
        expected="",
        note=f"{len(then.series)} observables, recorded on {then.header.machine}",
    )


def _unequal(then: Array, now: Array) -> float:
    """Largest difference of two series over the range of the first; infinite where only one of them is defined."""
    if then.shape != now.shape or not np.array_equal(np.isnan(then), np.isnan(now)):
        return math.inf
    if np.array_equal(then, now, equal_nan=True):
        return 0.0
    scale = float(np.nanmax(then) - np.nanmin(then)) or 1.0
    return float(np.nanmax(np.abs(then - now))) / scale


def _comparison(
    bed: Bed, gate: Gate, left: Side, right: Side, discrepancy: float | None, verdict: str, note: str = ""
) -> Comparison:
    return Comparison(
        case=bed.name,
        level=bed.scenes[0].level,
        check=gate.check,
        quantity=gate.quantity,
        unit=bed.unit(gate.quantity),
        left=left,
        right=right,
        discrepancy=discrepancy,
        scale=gate.scale,
        bound=gate.bound,
        bound_source=gate.bound_source,
        verdict=verdict,
        expected="",
        note=note,
    )


def _undecided(bed: Bed, gate: Gate, left: str, right: str, why: Exception) -> Comparison:
    text = str(why)
    verdict = text if text.startswith(("not-run", "not-comparable")) else not_comparable(text)
    sides = [Side(source, None, None, recorded=bed.recorded(source)) for source in (left, right)]
    return _comparison(bed, gate, sides[0], sides[1], None, verdict)


def _margin(gate: Gate, native: float) -> float:
    """The margin in the unit of the observable."""
    return gate.bound * abs(native) if gate.scale == "relative" else gate.bound


def _means(bed: Bed, gate: Gate) -> Iterator[Comparison]:
    """Two one-sided tests of native with each code."""
    for code in bed.codes:
        try:
            left, right = bed.values(NATIVE, gate.quantity), bed.values(code, gate.quantity)
            margin = _margin(gate, float(np.mean(left)))
            found = equivalence(left, right, margin)
        except (Undefined, BadSample) as why:
            yield _undecided(bed, gate, NATIVE, code, why)
            continue
        sides = [
            Side(source, side.mean, side.standard_error, "ensemble", recorded=bed.recorded(source))
            for source, side in ((NATIVE, found.left), (code, found.right))
        ]
        discrepancy = abs(found.difference) * gate.bound / margin
        note = found.describe(bed.unit(gate.quantity))
        yield _comparison(bed, gate, sides[0], sides[1], discrepancy, found.verdict, note)


def _curves(bed: Bed, gate: Gate) -> Iterator[Comparison]:
    """Largest difference of the mean curves of native and each code, against a band of resampled seeds."""
    for code in bed.codes:
        try:
            times, (left, right) = curves(bed, gate.quantity, NATIVE, code)
            found = compare_curves(times, left, right, gate.bound)
        except (Undefined, BadSample) as why:
            yield _undecided(bed, gate, NATIVE, code, why)
            continue
        at = int(np.searchsorted(times, found.time))
        sides = [
            Side(source, float(means[at]), float(found.half_width), "ensemble", recorded=bed.recorded(source))
            for source, means in ((NATIVE, found.left_mean), (code, found.right_mean))
        ]
        note = found.describe(bed.unit(gate.quantity))
        yield _comparison(bed, gate, sides[0], sides[1], found.largest, found.verdict, note)


def curves(bed: Bed, name: str, *sources: str) -> tuple[Array, list[Array]]:
    """An observable over the whole run at common times (T,) [s], one array (n, T) per source. Raises Undefined."""
    groups: list[list[tuple[Array, Array]]] = []
    for source in sources:
        members = bed.ensemble(source).members
        if any(name not in member.series for member in members):
            raise Undefined(f"{name} is not one number at each time")
        groups.append([(member.time, member[name]) for member in members])
    return aligned(*groups)


def _matched(bed: Bed, gate: Gate) -> Iterator[Comparison]:
    """Two one-sided tests of two codes under different laws, which the closed form of the gate makes alike."""
    sides = gate.matched
    form = reference.closed_forms().get(gate.reference or "")
    labels = bed.variant.split(",")
    if form is None:
        known = ", ".join(reference.closed_forms())
        raise UnknownQuantity(f"{bed.case}: no closed form {gate.reference} (known: {known})")
    if sides is None or sides.left.point not in labels:
        return
    partner = ",".join(sides.right.point if label == sides.left.point else label for label in labels)
    other = next((item for item in bed.siblings if item.variant == partner), None)
    names = [f"{side.code} ({side.point})" for side in (sides.left, sides.right)]
    if other is None:
        raise UnknownQuantity(f"{bed.case}: {bed.variant} has no partner {partner} for gates of {gate.quantity}")
    if not {sides.left.code, sides.right.code} <= set(bed.codes):
        return
    values = [float(form(replace(item.scenes[0], particles=item.scenes[0].particles[:2]))) for item in (bed, other)]
    alike = f"{gate.reference} {values[0]:.6g} and {values[1]:.6g}"
    try:
        if abs(values[0] - values[1]) > ALIKE * abs(values[1]):
            raise Undefined(f"the laws are not made alike: {alike}")
        left, right = bed.values(sides.left.code, gate.quantity), other.values(sides.right.code, gate.quantity)
        margin = _margin(gate, float(np.mean(left)))
        found = equivalence(left, right, margin)
    except (Undefined, BadSample) as why:
        text = str(why)
        verdict = text if text.startswith(("not-run", "not-comparable")) else not_comparable(text)
        yield _comparison(bed, gate, Side(names[0], None, None), Side(names[1], None, None), None, verdict)
        return
    one = Side(names[0], found.left.mean, found.left.standard_error, "ensemble", bed.recorded(sides.left.code))
    two = Side(names[1], found.right.mean, found.right.standard_error, "ensemble", other.recorded(sides.right.code))
    note = f"matched by {alike}; {found.describe(bed.unit(gate.quantity))}"
    discrepancy = abs(found.difference) * gate.bound / margin
    yield _comparison(bed, gate, one, two, discrepancy, found.verdict, note)


def _worst(bed: Bed, gate: Gate, largest: bool) -> Iterator[Comparison]:
    """Every seed of every source on the right side of the bound."""
    for source in (NATIVE, *bed.codes):
        try:
            values = bed.values(source, gate.quantity)
        except Undefined as why:
            yield _undecided(bed, gate, source, BOUND, why)
            continue
        worst = float(np.max(values) if largest else np.min(values))
        beyond = worst - gate.bound if largest else gate.bound - worst
        left = Side(source, worst, None, recorded=bed.recorded(source))
        right = Side(BOUND, gate.bound, 0.0)
        seeds = f"{'largest' if largest else 'smallest'} of {len(values)} seeds"
        mean = f", mean {sample(values, source).mean:.6g}" if len(values) > 1 else ""
        verdict = DIFFER if math.isnan(beyond) or beyond > 0.0 else AGREE
        yield _comparison(bed, gate, left, right, max(beyond, 0.0), verdict, seeds + mean)


ENSEMBLE_CHECKS: dict[str, Callable[[Bed, Gate], Iterator[Comparison]]] = {
    "equivalence": _means,
    "equivalence_curve": _curves,
    "matched": _matched,
    "at_least": lambda bed, gate: _worst(bed, gate, largest=False),
    "at_most": lambda bed, gate: _worst(bed, gate, largest=True),
}
