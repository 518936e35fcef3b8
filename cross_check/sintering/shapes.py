"""How the value of a target follows from quantities: a level, a growth, a ratio, a rank correlation ..."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np

from cross_check.sintering.errors import StudyError
from cross_check.sintering.law import softening
from cross_check.sintering.study import NotPlanned, Sample, Study, Values, over


@dataclass(frozen=True)
class Evidence:
    """The value that is judged, the same of each seed alone, and words on how it came about."""

    value: float
    seeds: list[float] = field(default_factory=list[float])
    note: str = ""


Shape = Callable[[Study, Sample, dict[str, Any]], Evidence]


def level(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """The mean over the seeds. `times` instead of one time: the extreme one of the means, by `worst`."""
    times, worst = _times(study, sample, asked), _worst(asked)
    curves = [study.values(asked["quantity"], replace(sample, time=time)) for time in times]
    means = [_mean(curve) for curve in curves]
    return Evidence(worst(means), [worst(values) for values in _by_seed(curves)], _listed(times, means))


def growth(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """The smallest step of the seed mean from one sintering time to the next; of the fall, where `falls`."""
    times = _times(study, sample, asked)
    if len(times) < 2:
        raise NotPlanned("a growth needs two sintering times")
    sign = -1.0 if asked.get("falls") else 1.0
    curves = [study.values(asked["quantity"], replace(sample, time=time)) for time in times]
    means = [_mean(curve) for curve in curves]
    seeds = [float(np.min(sign * np.diff(values))) for values in _by_seed(curves)]
    return Evidence(float(np.min(sign * np.diff(means))), seeds, _listed(times, means))


def ratio(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """Seed mean of one sample over that of another; over several times the extreme one, by `worst`.

    Samples of one size are compared over the seeds that both have: a seed is the same packing in every mode.
    """
    return _pairwise(study, sample, asked, over)


def difference(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """Seed mean of one sample less that of another, over the seeds of `ratio`; its size where `size`."""
    return _pairwise(study, sample, asked, lambda one, other: one - other)


def _pairwise(
    study: Study, sample: Sample, asked: dict[str, Any], combine: Callable[[float, float], float]
) -> Evidence:
    times, worst = _times(study, sample, asked), _worst(asked)
    quantity = asked["quantity"]
    found: list[float] = []
    by_time: list[Values] = []
    for time in times:
        left, right = (replace(sample, **({"time": time} | asked.get(side, {}))) for side in ("of", "to"))
        one = study.values(quantity, left)
        other = study.values(asked.get("to_quantity", quantity), right)
        both = one.keys() & other.keys()
        if left.count == right.count and both:
            one, other = ({seed: values[seed] for seed in sorted(both)} for values in (one, other))
        found.append(combine(_mean(one), _mean(other)))
        by_time.append({seed: combine(one[seed], other[seed]) for seed in one if seed in other})
    size = abs if asked.get("size") else float
    note = _listed(times, found) if len(times) > 1 else ""
    return Evidence(size(worst(found)), [size(worst(values)) for values in _by_seed(by_time)], note)


def rank(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """Spearman's rank correlation of the seed mean with the sintering time."""
    times = _times(study, sample, asked)
    if len(times) < 3:
        raise NotPlanned("a rank correlation needs three sintering times")
    curves = [study.values(asked["quantity"], replace(sample, time=time)) for time in times]
    means = [_mean(curve) for curve in curves]
    seeds = [_rank(times, values) for values in _by_seed(curves)]
    return Evidence(_rank(times, means), seeds, _listed(times, means))


def steepest_fall(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """The largest factor by which the seed mean falls from one sintering time to the next; below 1 where it rises."""
    times = _times(study, sample, asked)
    if len(times) < 2:
        raise NotPlanned("a fall needs two sintering times")
    curves = [study.values(asked["quantity"], replace(sample, time=time)) for time in times]
    means = np.array([_mean(curve) for curve in curves])
    seeds = [float(np.max(values[:-1] / values[1:])) for values in map(np.asarray, _by_seed(curves))]
    return Evidence(float(np.max(means[:-1] / means[1:])), seeds, _listed(times, means.tolist()))


def gain_ratio(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """[q(t) - q(base)] at the higher pressure over the same at the lower; the smallest over the times."""
    times = _times(study, sample, asked)

    def gain(pressure: int, time: float) -> tuple[float, Values]:
        at = replace(sample, pressure=pressure, time=time)
        after = study.values(asked["quantity"], at)
        before = study.values(asked["quantity"], replace(at, time=float(asked["base"])))
        return _mean(after) - _mean(before), {seed: after[seed] - before[seed] for seed in after if seed in before}

    found: list[float] = []
    by_time: list[Values] = []
    for time in times:
        (high, highs), (low, lows) = gain(100, time), gain(10, time)
        found.append(over(high, low))
        by_time.append({seed: over(highs[seed], lows[seed]) for seed in highs if seed in lows})
    return Evidence(_least(found), [_least(values) for values in _by_seed(by_time)], _listed(times, found))


def jump_ratio(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """The factor from one sintering time to a later one, at the lower pressure over that at the higher."""
    first, last = asked["from"], asked["until"]

    def jump(pressure: int) -> tuple[float, Values]:
        at = replace(sample, pressure=pressure)
        after = study.values(asked["quantity"], replace(at, time=last))
        before = study.values(asked["quantity"], replace(at, time=first))
        seeds = {seed: over(after[seed], before[seed]) for seed in after if seed in before}
        return over(_mean(after), _mean(before)), seeds

    (low, lows), (high, highs) = jump(10), jump(100)
    seeds = [over(lows[seed], highs[seed]) for seed in lows if seed in highs]
    return Evidence(over(low, high), seeds, f"{low:.3g} / {high:.3g}")


def deviation(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """The largest relative deviation from listed values, one for each sintering time."""
    listed = {float(time): float(value) for time, value in asked["values"].items()}
    times = _times(study, sample, asked | {"times": list(listed)})
    worst: dict[int, float] = {}
    for time in times:
        for seed, value in study.values(asked["quantity"], replace(sample, time=time)).items():
            worst[seed] = _most([worst.get(seed, 0.0), abs(value / listed[time] - 1.0)])
    return Evidence(_most(list(worst.values())), list(worst.values()), "every seed, every time")


def softening_rate(study: Study, sample: Sample, asked: dict[str, Any]) -> Evidence:
    """The largest relative deviation of the rate at which the cold contact softens, over temperatures [K].

    (k1(T) - k1)^2/(k1(T) k1), the rate times t0/k1, follows from eq. 12 at its first step; `values` are by temperature.
    """
    relaxation, step = 1e3, 1e-6
    found: dict[float, float] = {}
    for temperature in map(float, asked["values"]):
        hot = np.array([float(asked["cold"]), temperature])
        k1 = softening(study.law, np.array([0.0, step]), hot, np.full(2, relaxation))
        found[temperature] = abs(float(k1[1] - k1[0])) / step * relaxation / float(study.law["k1"])
    rates = list(found.values())
    rises = all(low < high for low, high in pairwise(rates))
    worst = _most([abs(found[float(at)] / float(value) - 1.0) for at, value in asked["values"].items()])
    note = ", ".join(f"{rate:.4g} at {at:g} K" for at, rate in found.items())
    return Evidence(worst if rises else np.nan, [worst], note if rises else f"does not rise: {note}")


SHAPES: dict[str, Shape] = {
    "level": level,
    "growth": growth,
    "ratio": ratio,
    "difference": difference,
    "rank": rank,
    "steepest_fall": steepest_fall,
    "gain_ratio": gain_ratio,
    "jump_ratio": jump_ratio,
    "deviation": deviation,
    "softening_rate": softening_rate,
}


def _times(study: Study, sample: Sample, asked: dict[str, Any]) -> list[float]:
    """The sintering times that are asked for and planned; the quick form has two of them."""
    if "times" not in asked:
        return [sample.time]
    planned = {run.sintering_time for run in study.outcomes if run.count == sample.count and run.mode == sample.mode}
    found = [float(time) for time in asked["times"] if float(time) in planned]
    if not found:
        raise NotPlanned(f"none of the sintering times {asked['times']}")
    return found


def _worst(asked: dict[str, Any]) -> Callable[[list[float]], float]:
    known: dict[str, Callable[[list[float]], float]] = {"min": _least, "max": _most}
    name = asked.get("worst", "min")
    if name not in known:
        raise StudyError(f"worst = {name!r}: unknown (known: {', '.join(known)})")
    return known[name]


def _rank(times: list[float], values: list[float]) -> float:
    """NaN where all values are the same: they have no rank."""
    # It takes a second to import, which every command would wait for.
    from scipy.stats import spearmanr  # pyright: ignore[reportUnknownVariableType]

    found: Any = spearmanr(times, values) if np.ptp(values) > 0.0 else None
    return np.nan if found is None else float(found.statistic)


def _mean(values: Values) -> float:
    return float(np.mean(list(values.values())))


def _least(values: list[float]) -> float:
    return float(np.min(values))  # of which NaN is the least, as it is the most


def _most(values: list[float]) -> float:
    return float(np.max(values))


def _by_seed(curves: list[Values]) -> list[list[float]]:
    """The values of each seed that all have."""
    common = [seed for seed in curves[0] if all(seed in curve for curve in curves)]
    return [[curve[seed] for curve in curves] for seed in common]


def _listed(times: list[float], values: list[float]) -> str:
    if len(times) < 2:
        return ""
    return ", ".join(f"{value:.4g} at {time:g} s" for time, value in zip(times, values, strict=True))
