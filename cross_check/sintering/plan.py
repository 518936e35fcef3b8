"""The runs of the sintering study: which case, which variant, which seed, with what changed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

BOX, COOLED, COMPRESSION, FAST, VIBRATION, THREE = "box", "cooled", "compression", "fast", "vibration", "three"
TESTS = (BOX, COOLED, COMPRESSION, FAST, VIBRATION, THREE)
CASES = {
    BOX: "sintering-box",
    COOLED: "sintering-cooled",
    COMPRESSION: "sintering-compression",
    FAST: "sintering-compression",
    VIBRATION: "sintering-vibration",
    THREE: "sintering-three",
}
PRESSURES = (10, 100)
# Sintering times [s] as the names of variants write them.
TIMES = {1e-4: "1e-4", 0.01: "0.01", 0.02: "0.02", 0.05: "0.05", 0.2: "0.2", 1.0: "1"}
QUICK_TIMES = (0.01, 1.0)
PLAIN = "plain"
# Depth of a case below the preparation; a branch states the overrides of what it starts from behind `start.`.
_DEPTH = {BOX: 0, THREE: 0, COOLED: 1, COMPRESSION: 2, FAST: 2, VIBRATION: 2}
# Compression in 0.1 s at p = 10 N/m too: what its variant sets, without the longer stage.
_FAST_TEST = 'vary.0.points.0.set={ "bodies.2.motion.load.value" = 10, "bodies.3.motion.load.value" = 10 }'


@dataclass(frozen=True)
class Mode:
    """What a mode changes in the texts of the cases: in all of them, in the box, and in the cooling.

    `stretch` is the factor of the times of preparation, heating and cooling, `hot` the time of the last stage of the
    box [s], and `halvings` how often the time step is halved.
    """

    everywhere: tuple[str, ...] = ()
    box: tuple[str, ...] = ()
    cooled: tuple[str, ...] = ()
    stretch: float = 1.0
    hot: float = 1.0
    halvings: int = 0


def _slower(factor: float) -> Mode:
    """Preparation, heating and cooling `factor` times as long."""
    box = (f"stages.0.end.value={0.2 * factor!r}", f"stages.1.end.value={0.1 * factor!r}")
    return Mode(box=box, cooled=(f"stages.0.end.value={0.1 * factor!r}",), stretch=factor)


_IMPLICIT = 'model.normal.cooling="implicit"'
_NO_EXPANSION = "materials.0.thermal.expansion=0"
_FRICTIONAL = ("pairs.0.values.friction=0.5", "pairs.1.values.friction=0.5")
# What friction alone does as it is switched: the temperature is held, and no branch follows.
_UNHEATED = ("stages.1.actions.2.to=353.15", "stages.2.end.value=0.1")
MODES = {
    PLAIN: Mode(),
    "implicit": Mode(everywhere=(_IMPLICIT,)),
    "no_expansion": Mode(everywhere=(_NO_EXPANSION,)),
    "implicit_no_expansion": Mode(everywhere=(_IMPLICIT, _NO_EXPANSION)),
    "frictional_prep": Mode(box=_FRICTIONAL),
    "frictional_prep_unheated": Mode(box=(*_FRICTIONAL, *_UNHEATED), hot=0.1),
    "slower_2": _slower(2.0),
    "slower_4": _slower(4.0),
    "sliding_off": Mode(everywhere=('model.tangential.sliding="off"',)),
    "sliding_brittle": Mode(everywhere=('model.tangential.sliding="brittle"',)),
    "half_step": Mode(everywhere=("time.step.value=1.5e-7",), halvings=1),
}
# Controls and variants are run at N = 100, for the longest sintering time; frictional preparation also at N = 300.
_CONTROLS = tuple(mode for mode in MODES if mode != PLAIN)
_FRICTIONAL_MODES = ("frictional_prep", "frictional_prep_unheated")
_CONTROLS_COMPRESSED = ("implicit", "no_expansion", "sliding_off", "sliding_brittle", "half_step")
SEEDS = {100: 8, 300: 2, 3: 3}
CONTROL_SEEDS = 3


@dataclass(frozen=True)
class Run:
    """One run: a test of a sample of `count` disks under `pressure` [N/m] that was hot for `sintering_time` [s].

    The box serves all sintering times, and the three particles have one: theirs is None.
    """

    test: str
    pressure: int
    count: int
    seed: int
    sintering_time: float | None = None
    mode: str = PLAIN

    @property
    def case(self) -> str:
        """Name of the case."""
        return CASES[self.test]

    @property
    def variant(self) -> str:
        """Name of the variant of the case."""
        if self.test == THREE:
            return f"p={self.pressure}"
        box = f"p={self.pressure},N={self.count}"
        return box if self.sintering_time is None else f"{box},t={TIMES[self.sintering_time]}"

    @property
    def name(self) -> str:
        """`sintering-cooled/p=10,N=100,t=1/seed=1 (implicit)`."""
        notes = [self.mode] * (self.mode != PLAIN) + ["in 0.1 s"] * (self.test == FAST)
        return f"{self.case}/{self.variant}/seed={self.seed}" + (f" ({', '.join(notes)})" if notes else "")

    @property
    def overrides(self) -> list[str]:
        """What is changed in the text of the case, and in those of the cases that it starts from."""
        mode, depth = MODES[self.mode], _DEPTH[self.test]
        found = [f"ensemble.seeds=[{self.seed}]"] + [_FAST_TEST] * (self.test == FAST)
        for level in range(depth + 1):
            below = "start." * level
            changed = mode.everywhere + mode.box * (level == depth) + mode.cooled * (depth - level == 1)
            found += [below + text for text in changed]
        return found

    @property
    def parent(self) -> Run | None:
        """The run from which this one branches off."""
        if self.test == COOLED:
            return replace(self, test=BOX, sintering_time=None)
        return replace(self, test=COOLED) if _DEPTH[self.test] == 2 else None

    @property
    def root(self) -> Run:
        """The first run of its series: the branches of one box belong together."""
        return self if self.parent is None else self.parent.root

    @property
    def duration(self) -> float:
        """Simulated time of the branch alone [s]."""
        mode = MODES[self.mode]
        spans = {
            BOX: 0.3 * mode.stretch + mode.hot,
            COOLED: 0.1 * mode.stretch + 0.1,
            COMPRESSION: 0.4 if self.pressure == PRESSURES[0] else 0.1,
            FAST: 0.1,
            VIBRATION: 0.1,
            THREE: 1.5,
        }
        return spans[self.test]

    @property
    def work(self) -> float:
        """What the run costs beside others: particles times time, a halved step counts twice."""
        return self.count * self.duration * 2.0 ** MODES[self.mode].halvings


def plan(full: bool, seeds: int | None = None) -> tuple[Run, ...]:
    """The runs of the quick or the full form, parents before their branches, the large samples first.

    `seeds` limits the seeds of every sample; the quick form has one if absent.
    """
    if not full:
        return _ordered(_sample(p, 100, seed, QUICK_TIMES) for p in PRESSURES for seed in range(1, (seeds or 1) + 1))

    def first(count: int) -> range:
        return range(1, min(count, seeds or count) + 1)

    def samples() -> Iterable[list[Run]]:
        for count in (300, 100):
            for pressure in PRESSURES:
                for seed in first(SEEDS[count]):
                    yield _sample(pressure, count, seed, tuple(TIMES))
        for pressure in PRESSURES:
            for seed in first(SEEDS[300]):
                for mode in _FRICTIONAL_MODES:
                    yield _control(mode, pressure, 300, seed)
            for seed in first(CONTROL_SEEDS):
                yield from (_control(mode, pressure, 100, seed) for mode in _CONTROLS)
            yield [Run(THREE, pressure, 3, seed) for seed in first(SEEDS[3])]

    return _ordered(samples())


def _sample(pressure: int, count: int, seed: int, times: tuple[float, ...]) -> list[Run]:
    """A sample with all its branches, in the order of the sintering times."""
    tests = (COOLED, COMPRESSION, *([FAST] if pressure == PRESSURES[0] else []), VIBRATION)
    box = Run(BOX, pressure, count, seed)
    return [box, *(replace(box, test=test, sintering_time=time) for test in tests for time in times)]


def _control(mode: str, pressure: int, count: int, seed: int) -> list[Run]:
    """A sample prepared or computed otherwise, with the longest sintering time."""
    box = Run(BOX, pressure, count, seed, mode=mode)
    if MODES[mode].hot < 1.0:
        return [box]  # nothing branches off in it
    tests = (COOLED, COMPRESSION) if mode in _CONTROLS_COMPRESSED else (COOLED,)
    return [box, *(replace(box, test=test, sintering_time=1.0) for test in tests)]


def _ordered(samples: Iterable[list[Run]]) -> tuple[Run, ...]:
    """All runs, the most expensive series first, so that none is left running alone at the end."""
    ranked = sorted(samples, key=lambda runs: -sum(run.work for run in runs))
    return tuple(run for runs in ranked for run in runs)
