"""The samples of an adaptive estimate, look after look: small ones within one kernel call, large
ones cut and spread over threads like any other work.

A look at N samples per replicate spends its share of the error level on the interval of its
replicates. `climb` is a template: its capitalised names are bound to kernels of the same model.
"""
from __future__ import annotations

import ctypes
import functools
import math
from array import array
from typing import NamedTuple

from montecarlo_brdf.compile.bind import Ints, Out, Reals, hole
from montecarlo_brdf.compile.kernel import Kernel, kernel
from montecarlo_brdf.compile.layout import Layout
from montecarlo_brdf.estimate.evaluate import Job, run
from montecarlo_brdf.estimate.moments import STATE, kernel_of, template_of
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Integrand
from montecarlo_brdf.sampling.directions import PROBES, Sampler
from montecarlo_brdf.sampling.points import NONE, SETS, SHAPES, PointSet, stream
from montecarlo_brdf.statistics import FLOOR, quantile
from montecarlo_brdf.vectors import Vec

FIRST = 64  # samples of a replicate at the first look,
FINE, FIRST_FINE = 1e-5, 256  # and where the target is finer than that: less has no chance
# of lattices; then powers of 2
LATTICES, LATTICES_FINE = (64, 144, 448, 648, 1024), (144, 448, 648, 1024)
FALL, LATTICES_FALL = 32.0, 1000.0  # the most that an error was seen to fall between sizes
#: log2 of the samples of the last look
MOST: dict[str, int] = {**dict.fromkeys(PointSet, 20), PointSet.INDEPENDENT: 22}
#: A sampler's weight may be 0 once in a million draws (a rejected direction) and 1 otherwise: until
#: one was seen all replicates agree. An event of probability `target` stays unseen in
#: SEEN/target samples with chance e^-SEEN. A probed chart has no such events.
SEEN = 10.0
#: The most samples that are looked at within one call. Which looks these are must not depend on how
#: fast they are: the two ways differ in the last bits.
NEAR = 1 << 15
LEVEL = 0.01  # of the interval that must be below the target, over all looks
SHARE = 0.25  # largest share of a replicate's total that a probed value may have

#: places in `ints` after those of `moments`: (place of the target in reals, sizes that this call
#: may take, index of the next size, looks taken, sizes in the table), then COLUMNS per size
AT, STOP, NEXT, TAKEN, SIZES, TABLE = 10, 11, 12, 13, 14, 15
COLUMNS = 6  # samples of a replicate and the shape of the point set
#: places in `reals` from the target on: (target, fewest samples, need that ends it, how much an
#: error may fall from one size to the next), then a factor for each look
FEWEST, HOPELESS, STEEPEST, FACTORS = 1, 2, 3, 4

MOMENTS = HIGHEST = CHANNELS = hole()
PROBED = hole()  # how many directions, 0 for none


def climb(ints: Ints, reals: Reals, out: Out) -> None:
    """Look at the sizes of the table, smallest first, until the target is met.

    out: the states of the last look as `moments` leaves them, the largest probed value of each
    channel, the samples that these demand, and the largest relative half-width of every look.
    """
    many, at = ints[2], ints[AT]
    end = STATE * CHANNELS * many
    told = end + CHANNELS
    if PROBED > 0:
        ints[2], ints[4] = 1, PROBED
        HIGHEST(ints, reals, out)
        ints[2] = many
    for k in range(CHANNELS):
        out[end + k] = out[STATE * k + 3] if PROBED > 0 else 0.0
    while ints[NEXT] < ints[STOP]:
        for i in range(end):
            out[i] = 0.0
        for i in range(COLUMNS):
            ints[4 + i] = ints[TABLE + COLUMNS * ints[NEXT] + i]
        MOMENTS(ints, reals, out)
        worst = widest(out, CHANNELS, many, reals[at + FACTORS + ints[TAKEN]])
        need = needed(out, CHANNELS, many, end)
        ints[TAKEN] += 1
        out[told], out[told + ints[TAKEN]] = need, worst
        if need > reals[at + HOPELESS]:
            return
        if worst <= reals[at] and max(need, reals[at + FEWEST]) <= ints[4]:
            return
        ints[NEXT] += stride(worst, reals[at] * reals[at + STEEPEST], ints[SIZES] - ints[NEXT])


def stride(worst: float, reachable: float, left: int) -> int:
    """Sizes to go on by: no look is spent where the target cannot be; the last is not skipped."""
    return 2 if worst > reachable and left > 2 else 1


def widest(states: Reals, width: int, count: int, factor: float) -> float:
    """The largest relative half-width over the channels, from the means of the replicates."""
    worst = 0.0
    floor = FLOOR * math.sqrt(count * (count - 1.0))
    for k in range(width):
        mean, spread = 0.0, 0.0
        for r in range(count):
            mean += states[(r * width + k) * STATE + 1]
        mean /= count
        for r in range(count):
            d = states[(r * width + k) * STATE + 1] - mean
            spread += d * d
        size = abs(mean)
        half = factor * max(math.sqrt(spread), floor * size)
        # relative to the true value, which may be smaller than the mean by the half-width
        near = half / (size - half) if half < size else (math.inf if half > 0.0 else 0.0)
        worst = max(worst, near if mean == mean else math.inf)
    return worst


def needed(states: Reals, width: int, count: int, end: int) -> float:
    """Samples that the probed values at states[end...] demand, beside the means."""
    need = 0.0
    for k in range(width):
        mean = 0.0
        for r in range(count):
            mean += states[(r * width + k) * STATE + 1]
        size, high = SHARE * abs(mean) / count, states[end + k]
        need = max(need, high / size if size > 0.0 else (math.inf if high > 0.0 else 0.0))
    return need


def looks_of(
    model: str, points: str, mean: Integrand, probe: Integrand | None, layout: Layout
) -> Kernel:
    """The kernel of all looks: a mean, and how to probe its integrand if at all."""
    means = template_of(points, [mean], layout)
    highest = template_of("counted", [probe], layout) if probe else means
    count, channels = PROBES if probe else 0, len(layout.places)
    return kernel(model, climb, MOMENTS=means, HIGHEST=highest, PROBED=count, CHANNELS=channels)


@functools.cache
def factors(replicates: int, looks: int) -> tuple[float, ...]:
    """Half-width of each look over the root of the sum of squared deviations of the means."""
    scale = math.sqrt(replicates * (replicates - 1))
    return tuple(
        quantile(0.5 * LEVEL * 0.5 ** (k + 1), replicates - 1) / scale
        for k in range(looks)
    )


class Method(NamedTuple):
    """A sampler or chart, a point set, and why they were picked."""

    sampler: Sampler
    points: PointSet
    why: str


class Setting(NamedTuple):
    """All that estimating a model with one parameter set needs, whatever the direction."""

    method: Method
    mean: Integrand
    layout: Layout
    looks: Kernel
    probed: bool
    numbers: tuple[float, ...]
    width: float  # of the lobe
    identity: str
    model: str

    @property
    def channels(self) -> int:
        """Number of parameter sets."""
        return len(self.layout.places)

    def means(self) -> Kernel:
        """The kernel of the mean alone."""
        return kernel_of(self.model, self.method.points, [self.mean], self.layout)


class Ascent:
    """One stream of a case. `hopeless`: samples that a probed value may demand at most."""

    def __init__(self, setting: Setting, wo: Vec, plan: Plan, hopeless: float) -> None:
        self._setting, self._many = setting, plan.replicates
        target = plan.target_error or 0.0
        fewest = 0.0 if setting.probed or not target else SEEN / (target * plan.replicates)
        reals = (*wo, setting.width, *setting.numbers)
        template, self.sizes, self._near, steps = _table(
            setting.method.points, plan.replicates, target <= FINE, fewest, len(reals)
        )
        self._key = stream(plan.seed, setting.identity, *wo)
        self._ints = array("q", template)
        self._ints[0] = self._key - (self._key >> 63 << 64)
        fall = LATTICES_FALL if setting.method.points == PointSet.LATTICE else FALL
        self._reals = array("d", (*reals, target, fewest, hopeless, fall, *steps))
        channels = setting.channels
        self._end = STATE * channels * plan.replicates
        self._out = array("d", bytes(8 * (self._end + channels + 1 + len(steps))))
        self._at = [a.buffer_info()[0] for a in (self._ints, self._reals, self._out)]
        self._target, self._fewest, self._fall = target, fewest, fall
        self.states: list[float] = []
        self.errors: list[float] = []  # largest relative half-width at each look
        self.need = 0.0  # samples of a replicate that the probed values demand
        self.size = 0  # samples of a replicate at the last look

    def climb(self, plan: Plan) -> None:
        """At least one more look."""
        if self._near > self._ints[NEXT]:
            self.look(self._near)
        else:
            self._look_far(plan)

    def look(self, stop: int) -> None:
        """Look at sizes below the index `stop` until the target is met; at least at the probes."""
        ints, before = self._ints, self._ints[TAKEN]
        ints[STOP] = stop
        self._setting.looks(*self._at)
        out, told = self._out.tolist(), self._end + self._setting.channels
        self.need, self.size = out[told], ints[4]
        self.errors += out[told + 1 + before : told + 1 + ints[TAKEN]]
        self.states = out[: self._end]

    def _look_far(self, plan: Plan) -> None:
        """One look at more samples than a single call should take."""
        ints, width, points = self._ints, self._setting.channels, self._setting.method.points
        self.look(ints[NEXT])
        self.size = self.sizes[ints[NEXT]]
        shape = SHAPES[points](self.size) if points in SHAPES else NONE
        means, reals = self._setting.means(), self._reals[:]
        job = Job(means, reals, width, self._key, self._many, self.size, shape)
        rows = zip(*run(job, plan.threads, plan.sums), strict=True)
        self.states = [x for row in rows for moments in row for x in moments]
        factor = self._reals[ints[AT] + FACTORS + ints[TAKEN]]
        ints[TAKEN] += 1
        self.errors.append(widest(self.states, width, self._many, factor))
        seen = self.states + self._out[self._end : self._end + width].tolist()
        self.need = needed(seen, width, self._many, self._end)
        if not self.reached():
            left = ints[SIZES] - ints[NEXT]
            ints[NEXT] += stride(self.errors[-1], self._target * self._fall, left)

    def reached(self) -> bool:
        """Whether the last look is good enough."""
        return self.errors[-1] <= self._target and max(self.need, self._fewest) <= self.size

    def ended(self) -> bool:
        """Whether the last look was at the largest size."""
        return bool(self._ints[NEXT] >= self._ints[SIZES])


@functools.cache
def _table(
    points: str, many: int, fine: bool, fewest: float, at: int
) -> tuple[bytes, tuple[int, ...], int, tuple[float, ...]]:
    """What `climb` gets as ints, the sizes of all looks, how many of them are near, and the
    factors of their widths."""
    last = min(1 << MOST[points], SETS[points][0])
    first = FIRST_FINE if fine else FIRST
    start = (LATTICES_FINE if fine else LATTICES) if points == PointSet.LATTICE else (first,)
    sizes = (*start, *(1 << k for k in range(start[-1].bit_length(), last.bit_length())))
    sizes = tuple(size for size in sizes if size >= fewest) or (last,)
    ints = [0, 0, many, 0, 0, *NONE, at, 0, 0, 0, len(sizes)]
    assert len(ints) == TABLE
    for size in sizes:
        ints += (size, *(SHAPES[points](size) if points in SHAPES else NONE))
    near = sum(size * many <= NEAR for size in sizes)
    packed = bytes((ctypes.c_uint64 * len(ints))(*ints))
    return packed, sizes, near, factors(many, len(sizes))
