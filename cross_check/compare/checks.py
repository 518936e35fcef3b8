"""The checks of a gate: which sources are compared, how, and what the verdict is."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cross_check import reference
from cross_check.compare import trajectories
from cross_check.compare.differences import UnknownDifference, cause
from cross_check.compare.outcome import NATIVE, Outcomes, mirror_name
from cross_check.compare.quantities import QUANTITIES, Quantity, Undefined
from cross_check.compare.quantity import UnknownQuantity
from cross_check.compare.samples import BadSample
from cross_check.compare.verdicts import (
    AGREE,
    DIFFER,
    INCONCLUSIVE,
    Comparison,
    Side,
    known_difference,
    not_comparable,
    not_run,
)
from cross_check.engine import Gate
from cross_check.record import Array
from cross_check.scene import Scene

REFERENCE = "reference"


@dataclass(frozen=True)
class Bench:
    """Everything that the checks of one gate of one variant need."""

    scene: Scene
    gate: Gate
    quantity: Quantity
    outcomes: Outcomes
    codes: tuple[str, ...]

    def value(self, source: str, refinement: int = 0) -> Any:
        """The quantity of a source: a number, or a series with its steps. Raises Undefined."""
        outcome = self.outcomes[source, refinement]
        if outcome.record is None:
            raise Undefined(outcome.verdict)
        scene = self.law_scene(source) if self.quantity.of_law else outcome.scene
        if self.quantity.scalar is not None:
            return self.quantity.scalar(scene, outcome.record)
        if self.quantity.series is None:
            raise Undefined(f"{self.quantity.name} has no formula")
        return outcome.record.step, self.quantity.series(scene, outcome.record)

    def law_scene(self, source: str) -> Scene:
        """The scene with the options of the law that made the record of a source: a code's are those of its mirror."""
        mirror = self.outcomes.get((mirror_name(source), 0))
        return self.outcomes[source, 0].scene if mirror is None else mirror.scene

    def uncertainty(self, source: str) -> tuple[float | None, str]:
        """Time-step error of a scalar: twice the change when the step is halved, of the source or of its mirror."""
        if self.quantity.scalar is None:
            return None, "none"
        source = source if source == NATIVE else mirror_name(source)
        try:
            coarse, fine = self.value(source, 0), self.value(source, 1)
        except (KeyError, Undefined):
            return None, "none"
        return 2.0 * abs(coarse - fine), "time step"

    def side(self, source: str, value: float | None) -> Side:
        """One side of a comparison, with the uncertainty of the source."""
        outcome = self.outcomes[source, 0]
        uncertainty, kind = (None, "none") if value is None else self.uncertainty(source)
        return Side(source, value, uncertainty, kind, recorded=outcome.origin == "recorded")

    def comparison(
        self, left: Side, right: Side, discrepancy: float | None, verdict: str, note: str = ""
    ) -> Comparison:
        """A line of verdicts.json whose expectation is still open."""
        return Comparison(
            case=self.scene.name,
            level=self.scene.level,
            check=self.gate.check,
            quantity=self.quantity.name,
            unit=self.quantity.unit,
            left=left,
            right=right,
            discrepancy=discrepancy,
            scale=self.gate.scale,
            bound=self.gate.bound,
            bound_source=self.gate.bound_source,
            verdict=verdict,
            expected="",
            note=note,
        )

    def undecided(self, left: str, right: str, why: str, note: str = "") -> Comparison:
        """A comparison without a number: what a source could not deliver, and why."""
        verdict = why if why.startswith(("not-run", "not-comparable")) else not_comparable(why)

        def empty(source: str) -> Side:
            recorded = (source, 0) in self.outcomes and self.outcomes[source, 0].origin == "recorded"
            return Side(source, None, None, recorded=recorded)

        return self.comparison(empty(left), empty(right), None, verdict, note)


def compare(scene: Scene, gate: Gate, outcomes: Outcomes, codes: tuple[str, ...]) -> Iterator[Comparison]:
    """All comparisons of one gate of one variant. Raises UnknownQuantity."""
    quantity = QUANTITIES.get(gate.quantity)
    if quantity is None:
        raise UnknownQuantity(f"{scene.case}: no quantity {gate.quantity} (known: {', '.join(QUANTITIES)})")
    check = CHECKS.get(gate.check)
    if check is None:
        raise UnknownQuantity(f"{scene.case}: this version has no check {gate.check} (known: {', '.join(CHECKS)})")
    yield from check(Bench(scene, gate, quantity, outcomes, codes))


def _closed_form(bench: Bench) -> reference.ClosedForm:
    forms = reference.closed_forms()
    name = bench.gate.reference or ""
    if name not in forms:
        raise UnknownQuantity(f"{bench.scene.case}: no closed form {name} (known: {', '.join(forms)})")
    return forms[name]


def _scaled(difference: float, scale: str, right: Array | float) -> float:
    """A difference in units of the gate's scale."""
    values = np.asarray(right)
    divisor = {
        "absolute": 1.0,
        "relative": float(np.max(np.abs(values))),
        "peak": float(np.max(np.abs(values))),
        "range": float(np.max(np.ptp(values, axis=0))) if values.ndim else abs(float(values)),
    }[scale]
    if divisor == 0.0:
        return 0.0 if difference == 0.0 else math.inf
    return difference / divisor


def _peak(series: Array) -> float:
    return float(np.max(np.abs(series)))


def _common(*series: tuple[Any, Array]) -> list[Array]:
    """Series at the steps that all of them have. Raises Undefined where these are fewer than two."""
    steps = series[0][0]
    for step, _ in series[1:]:
        steps = np.intersect1d(steps, step)
    if len(steps) < 2:
        raise Undefined("the records share fewer than two steps")
    return [values[np.isin(step, steps)] for step, values in series]


def _judge(bench: Bench, discrepancy: float, uncertainty: float | None = None) -> str:
    """Agree or differ; inconclusive where the uncertainty is as large as the bound."""
    if not discrepancy <= bench.gate.bound:  # a NaN differs
        return DIFFER
    return INCONCLUSIVE if uncertainty is not None and uncertainty > bench.gate.bound else AGREE


def _against_reference(bench: Bench) -> Iterator[Comparison]:
    form = _closed_form(bench)
    name = f"closed form {bench.gate.reference}"
    for source in (NATIVE, *bench.codes):
        try:
            value = bench.value(source)
        except Undefined as why:
            yield bench.undecided(source, REFERENCE, str(why), name)
            continue
        if bench.quantity.scalar is not None:
            target = float(form(bench.law_scene(source) if bench.quantity.of_law else bench.scene))
            left, right = bench.side(source, value), Side(REFERENCE, target, 0.0, "closed form")
            discrepancy = _scaled(abs(value - target), bench.gate.scale, target)
            error = None if left.uncertainty is None else _scaled(left.uncertainty, bench.gate.scale, target)
            yield bench.comparison(left, right, discrepancy, _judge(bench, discrepancy, error), name)
        else:
            step, series = value
            target = form(bench.scene, step)
            discrepancy = _scaled(_peak(series - target), bench.gate.scale, target)
            sides = bench.side(source, _peak(series)), Side(REFERENCE, _peak(target), 0.0, "closed form")
            yield bench.comparison(*sides, discrepancy, _judge(bench, discrepancy), name)


def _difference(bench: Bench, left: str, right: str) -> tuple[Side, Side, float]:
    """Both sides and the scaled difference of two sources. Raises Undefined."""
    one, other = bench.value(left), bench.value(right)
    if bench.quantity.scalar is not None:
        discrepancy = _scaled(abs(one - other), bench.gate.scale, other)
        return bench.side(left, one), bench.side(right, other), discrepancy
    first, second = _common(one, other)
    discrepancy = _scaled(_peak(first - second), bench.gate.scale, second)
    return bench.side(left, _peak(first)), bench.side(right, _peak(second)), discrepancy


def _missing(bench: Bench, *sources: str) -> str | None:
    """Why one of the sources has no record, or None."""
    return next(
        (bench.outcomes[source, 0].verdict for source in sources if bench.outcomes[source, 0].record is None), None
    )


def _mirrors(bench: Bench) -> Iterator[Comparison]:
    for code in bench.codes:
        mirror = mirror_name(code)
        try:
            left, right, discrepancy = _difference(bench, mirror, code)
        except Undefined as why:
            yield bench.undecided(mirror, code, _missing(bench, code, mirror) or str(why))
            continue
        yield bench.comparison(left, right, discrepancy, _judge(bench, discrepancy))


def _plain(bench: Bench) -> Iterator[Comparison]:
    for code in bench.codes:
        try:
            left, right, discrepancy = _difference(bench, NATIVE, code)
            verdict, note = _judge(bench, discrepancy), ""
            if verdict == DIFFER:
                verdict, note = _explained(bench, code)
        except Undefined as why:
            yield bench.undecided(NATIVE, code, _missing(bench, code, NATIVE) or str(why))
            continue
        yield bench.comparison(left, right, discrepancy, verdict, note)


def _explained(bench: Bench, code: str) -> tuple[str, str]:
    """The verdict on a difference of native and a code: known if the code's mirror predicts it."""
    mirror = mirror_name(code)
    _, _, unexplained = _difference(bench, mirror, code)
    if not unexplained <= bench.gate.bound:
        return DIFFER, f"{mirror} does not predict it: {unexplained:.3g} remains"
    try:
        identifier = cause(bench.outcomes[NATIVE, 0].scene, bench.outcomes[mirror, 0].scene)
    except UnknownDifference as unknown:
        return DIFFER, str(unknown)
    return known_difference(identifier), f"{mirror} predicts it to {unexplained:.3g}"


def _predictions(bench: Bench) -> Iterator[Comparison]:
    for one, other in itertools.combinations(bench.codes, 2):
        sources = (one, other, mirror_name(one), mirror_name(other))
        label = f"{sources[2]} - {sources[3]}"
        missing = _missing(bench, *sources)
        if missing is not None:
            yield bench.undecided(f"{one} - {other}", label, missing)
            continue
        series = [bench.value(source) for source in sources]
        if bench.quantity.scalar is not None:
            series = [(np.zeros(1), np.array([value])) for value in series]
            a, b, mirror_a, mirror_b = (values for _, values in series)
        else:
            a, b, mirror_a, mirror_b = _common(*series)
        discrepancy = _scaled(_peak((a - b) - (mirror_a - mirror_b)), bench.gate.scale, a)
        recorded = any(bench.outcomes[source, 0].origin == "recorded" for source in (one, other))
        left = Side(f"{one} - {other}", _peak(a - b), None, recorded=recorded)
        right = Side(label, _peak(mirror_a - mirror_b), None)
        yield bench.comparison(left, right, discrepancy, _judge(bench, discrepancy))


def _convergence(bench: Bench) -> Iterator[Comparison]:
    finer = f"{NATIVE} at half the step"
    try:
        coarse, fine = bench.value(NATIVE, 0), bench.value(NATIVE, 1)
    except KeyError:
        yield bench.undecided(NATIVE, finer, not_run("the case has no refinements"))
        return
    except Undefined as why:
        yield bench.undecided(NATIVE, finer, str(why))
        return
    order = math.log2(coarse / fine) if coarse > 0.0 and fine > 0.0 else math.nan
    low, high = bench.gate.order or (math.nan, math.nan)
    verdict = _judge(bench, coarse)
    if verdict == AGREE and not low <= order <= high:
        verdict = DIFFER
    sides = Side(NATIVE, coarse, None), Side(finer, fine, None)
    yield bench.comparison(*sides, coarse, verdict, f"order {order:.4f}, allowed {low} to {high}")


def _finest(bench: Bench) -> Iterator[Comparison]:
    """Native at its finest step; the note tells the errors of all steps and the order over the last halving."""
    yield _refined(bench, extrapolate=False)


def _extrapolated(bench: Bench) -> Iterator[Comparison]:
    """Native extrapolated to a vanishing step at first order (Richardson), which the quantity and the note say."""
    found = _refined(bench, extrapolate=True)
    yield replace(found, quantity=f"{found.quantity}, extrapolated")


def _refined(bench: Bench, extrapolate: bool) -> Comparison:
    form, name = _closed_form(bench), f"closed form {bench.gate.reference}"
    levels = sorted(level for source, level in bench.outcomes if source == NATIVE)
    try:
        values = [float(bench.value(NATIVE, level)) for level in levels]
    except Undefined as why:
        return bench.undecided(NATIVE, REFERENCE, str(why), name)
    target = float(form(bench.scene))
    errors = [_scaled(abs(value - target), bench.gate.scale, target) for value in values]
    order = math.log2(errors[-2] / errors[-1]) if min(errors[-2:]) > 0.0 else math.nan
    listed = ", ".join(f"{error:.2e} at step/{2**level}" for level, error in zip(levels, errors, strict=True))
    note = f"{name}; off by {listed}; order {order:.2f}"
    before, last = values[-2:]
    if extrapolate:
        before, last = 2.0 * values[-2] - values[-3], 2.0 * values[-1] - values[-2]
        note += "; judged is the value extrapolated from the last two"
    doubt = 2.0 * abs(last - before)
    discrepancy = _scaled(abs(last - target), bench.gate.scale, target)
    verdict = _judge(bench, discrepancy, _scaled(doubt, bench.gate.scale, target))
    left, right = Side(NATIVE, last, doubt, "time step"), Side(REFERENCE, target, 0.0, "closed form")
    return bench.comparison(left, right, discrepancy, verdict, note)


def _horizon(bench: Bench) -> Iterator[Comparison]:
    """How long each code stays with its mirror, which the bound judges; native beside it is reported in the note."""
    for code in bench.codes:
        mirror = mirror_name(code)
        try:
            found = trajectories.parting(bench.scene, bench.outcomes, mirror, code)
            plain = trajectories.parting(bench.scene, bench.outcomes, NATIVE, code)
        except (Undefined, BadSample) as why:
            yield bench.undecided(mirror, code, str(why))
            continue
        window = found.deterministic_window
        left, right = Side(mirror, window, None), Side(code, float(found.times[-1]), None)
        short = max(bench.gate.bound - window, 0.0)
        note = (
            f"{mirror} and {code}: {trajectories.describe(found)}. {NATIVE} and {code}: {trajectories.describe(plain)}"
        )
        yield bench.comparison(left, right, short, DIFFER if short > 0.0 else AGREE, note)


CHECKS: dict[str, Callable[[Bench], Iterator[Comparison]]] = {
    "horizon": _horizon,
    "reference": _against_reference,
    "mirror": _mirrors,
    "plain": _plain,
    "prediction": _predictions,
    "convergence": _convergence,
    "finest": _finest,
    "extrapolated": _extrapolated,
}
