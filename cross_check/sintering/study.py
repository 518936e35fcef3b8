"""The outcomes of all runs, asked by quantity: which numbers of which samples, seed by seed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cross_check.sintering import plan
from cross_check.sintering.errors import StudyError
from cross_check.sintering.outcome import Outcome
from cross_check.sintering.plan import PLAIN, Run
from cross_check.sintering.states import MEAN_RADIUS

Values = dict[int, float]
"""A number for every seed."""

# Strain up to which the bonds of a sample at the lower pressure fail [-].
EARLY = 0.01


class NotPlanned(Exception):
    """The form of the study that ran does not hold such a run."""


class Failed(Exception):
    """A run of which a number is asked has failed; the message says why."""


def over(one: float, other: float) -> float:
    """A ratio, NaN over zero: a target that needs it is then missed."""
    return one / other if other != 0.0 else np.nan


@dataclass(frozen=True)
class Sample:
    """Which samples: pressure [N/m], number of disks, time for which they were hot [s], mode."""

    pressure: int
    count: int
    time: float = 1.0
    mode: str = PLAIN

    def run(self, test: str, seed: int) -> Run:
        """The run of a test of one of them."""
        # At the higher pressure, the test of the case is the fast one.
        slow = test == plan.FAST and self.pressure != plan.PRESSURES[0]
        kind = plan.COMPRESSION if slow else test
        time = None if kind in (plan.BOX, plan.THREE) else self.time
        return Run(kind, self.pressure, self.count, seed, time, self.mode)


@dataclass(frozen=True)
class Study:
    """All outcomes. `law` is the normal law of the cases, as the engine reads it; `full` says which form ran.

    `seeds_asked` is the number of seeds that the user asked for, None for those of the plan.
    """

    outcomes: dict[Run, Outcome]
    full: bool
    law: dict[str, Any]
    seeds_asked: int | None = None

    def seeds(self, test: str, sample: Sample) -> list[int]:
        """The seeds of which the study planned a test of a sample."""
        asked = sample.run(test, 0)
        return sorted(run.seed for run in self.outcomes if replace(run, seed=0) == asked)

    def outcome(self, test: str, sample: Sample, seed: int) -> Outcome:
        """What became of a run. Raises NotPlanned or Failed."""
        found = self.outcomes.get(sample.run(test, seed))
        if found is None:
            raise NotPlanned(sample.run(test, seed).name)
        if found.failure:
            raise Failed(f"{found.run.name}: {found.failure}")
        return found

    def number(self, test: str, name: str, sample: Sample, seed: int) -> float:
        """A number of a run. Raises NotPlanned, Failed, or StudyError for an unknown name."""
        numbers = self.outcome(test, sample, seed).numbers
        if name not in numbers:
            raise StudyError(f"{test}.{name}: no such number (known: {', '.join(sorted(numbers))})")
        return numbers[name]

    def values(self, quantity: str, sample: Sample) -> Values:
        """A quantity for every seed: `test.number`, or one of DERIVED. Raises NotPlanned, Failed or StudyError."""
        if quantity in DERIVED:
            test, derive = DERIVED[quantity]
            seeds = self.seeds(test, sample)
            found = {seed: derive(self, sample, seed) for seed in seeds}
        else:
            test, _, name = quantity.partition(".")
            if test not in plan.TESTS or not name:
                known = ", ".join((*DERIVED, *(f"{test}.NUMBER" for test in plan.TESTS)))
                raise StudyError(f"{quantity}: no such quantity (known: {known})")
            seeds = self.seeds(test, sample)
            found = {seed: self.number(test, name, sample, seed) for seed in seeds}
        if not found:
            raise NotPlanned(sample.run(test, 1).name)
        return found


def _rise(study: Study, sample: Sample, seed: int) -> float:
    """Density after cool-down over that before heating, less one."""
    cold = study.number(plan.BOX, "press_nu_geo", sample, seed)
    return study.number(plan.COOLED, "final_nu_geo", sample, seed) / cold - 1.0


def _three_rise(study: Study, sample: Sample, seed: int) -> float:
    cold = study.number(plan.THREE, "press_nu_geo", sample, seed)
    return study.number(plan.THREE, "relax_nu_geo", sample, seed) / cold - 1.0


def _cool_step(density: str) -> Callable[[Study, Sample, int], float]:
    """What cool-down and relaxation add to a density."""

    def step(study: Study, sample: Sample, seed: int) -> float:
        hot = study.number(plan.COOLED, f"hot_{density}", sample, seed)
        return study.number(plan.COOLED, f"final_{density}", sample, seed) - hot

    return step


def _heating_share(study: Study, sample: Sample, seed: int) -> float:
    """Size of the change of density while the temperature rises, over the change from before heating to the end."""
    return over(abs(_ramp(study, sample, seed)), _gain(study, sample, seed))


def _heat_alone(study: Study, sample: Sample, seed: int) -> float:
    """The same share less what friction alone does at that time, which the control without heat tells."""
    unheated = _ramp(study, replace(sample, mode=f"{sample.mode}_unheated"), seed)
    return over(abs(_ramp(study, sample, seed) - unheated), _gain(study, sample, seed))


def _ramp(study: Study, sample: Sample, seed: int) -> float:
    """Change of density over the stage in which the temperature rises."""
    before, after = (study.number(plan.BOX, f"{stage}_nu_geo", sample, seed) for stage in ("press", "heat"))
    return after - before


def _gain(study: Study, sample: Sample, seed: int) -> float:
    """Density after cool-down less that before heating."""
    cold = study.number(plan.BOX, "press_nu_geo", sample, seed)
    return study.number(plan.COOLED, "final_nu_geo", sample, seed) - cold


def _force_width(study: Study, sample: Sample, seed: int) -> float:
    """Standard deviation of the forces after cool-down [N]."""
    return study.number(plan.COOLED, "final_f_std", sample, seed) * 2.0 * MEAN_RADIUS * sample.pressure


def _early_failure_strain(study: Study, sample: Sample, seed: int) -> float:
    """Strain of the largest stress on the top wall up to a strain of EARLY: later, grains that lock may exceed it."""
    arrays = study.outcome(plan.COMPRESSION, sample, seed).arrays
    early = arrays["strain"] <= EARLY
    return float(arrays["strain"][early][np.argmax(arrays["sigma_zz"][early])])


def _of_cooled(combine: Callable[[Callable[[str], float]], float]) -> Callable[[Study, Sample, int], float]:
    """A combination of numbers of the cooled sample."""
    return lambda study, sample, seed: combine(lambda name: study.number(plan.COOLED, name, sample, seed))


def _of_fast(combine: Callable[[Callable[[str], float]], float]) -> Callable[[Study, Sample, int], float]:
    return lambda study, sample, seed: combine(lambda name: study.number(plan.FAST, name, sample, seed))


Derived = tuple[str, Callable[[Study, Sample, int], float]]
# Name: the test whose seeds there are, and what is computed for one seed.
DERIVED: dict[str, Derived] = {
    "rise": (plan.COOLED, _rise),
    "rise_of_three": (plan.THREE, _three_rise),
    "cool_step_geo": (plan.COOLED, _cool_step("nu_geo")),
    "cool_step_mat": (plan.COOLED, _cool_step("nu_mat")),
    "heating_share": (plan.COOLED, _heating_share),
    "heat_alone": (plan.COOLED, _heat_alone),
    "contact_densification": (plan.COOLED, _of_cooled(lambda of: 2.0 * of("hot_overlap_mean"))),
    "wall_deficit": (plan.COOLED, _of_cooled(lambda of: of("final_C_inside") - of("final_C_at_walls"))),
    "small_share_drop": (
        plan.COOLED,
        _of_cooled(lambda of: 1.0 - over(of("final_overlap_small_share"), of("hot_overlap_small_share"))),
    ),
    "overlap_widening": (plan.COOLED, _of_cooled(lambda of: over(of("final_overlap_std"), of("hot_overlap_std")))),
    "force_widening": (plan.COOLED, _of_cooled(lambda of: over(of("final_f_std"), of("hot_f_std")))),
    "largest_use_of_friction": (
        plan.COOLED,
        _of_cooled(lambda of: float(np.max([of("hot_mu_t_largest_share"), of("final_mu_t_largest_share")]))),
    ),
    "force_width": (plan.COOLED, _force_width),
    "early_failure_strain": (plan.COMPRESSION, _early_failure_strain),
    "bonds_lost": (plan.FAST, _of_fast(lambda of: 1.0 - of("at_survival_bonds_surviving"))),
    "attraction_lost": (
        plan.FAST,
        _of_fast(lambda of: 1.0 - over(of("at_survival_f_negative_share"), of("before_f_negative_share"))),
    ),
    "friction_gained": (
        plan.FAST,
        _of_fast(lambda of: of("at_survival_frictional_share") - of("before_frictional_share")),
    ),
}
