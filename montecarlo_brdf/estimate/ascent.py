"""The samples of an adaptive estimate, look after look: small ones within one kernel call, large
ones cut and spread over threads like any other work."""
from __future__ import annotations

import ctypes
import functools
from array import array

from montecarlo_brdf.estimate import looks, work
from montecarlo_brdf.estimate.looks import AT, NEXT, SIZES, STOP, TABLE, TAKEN
from montecarlo_brdf.estimate.methods import Setting
from montecarlo_brdf.estimate.moments import STATE
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.sampling.points import NONE, SETS, SHAPES
from montecarlo_brdf.sampling.streams import stream
from montecarlo_brdf.vectors import Vec

FIRST = 64  # samples of a replicate at the first look,
FINE, FIRST_FINE = 1e-5, 256  # and where the target is finer than that: less has no chance
# of lattices; then powers of 2
LATTICES, LATTICES_FINE = (64, 144, 448, 648, 1024), (144, 448, 648, 1024)
FALL, LATTICES_FALL = 32.0, 1000.0  # the most that an error was seen to fall between sizes
MOST = {"lattice": 20, "sobol": 20, "stratified": 20, "independent": 22}  # log2, the last look
#: A sampler's weight may be 0 once in a million draws (a rejected direction) and 1 otherwise: until
#: one was seen all replicates agree. An event of probability `target` stays unseen in
#: SEEN/target samples with chance e^-SEEN. A probed chart has no such events.
SEEN = 10.0
#: The most samples that are looked at within one call. Which looks these are must not depend on how
#: fast they are: the two ways differ in the last bits.
NEAR = 1 << 15


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
        fall = LATTICES_FALL if setting.method.points == "lattice" else FALL
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
        job = work.Job(means, reals, width, self._key, self._many, self.size, shape)
        rows = zip(*work.run(job, plan.threads, None, plan.sums), strict=True)
        self.states = [x for row in rows for moments in row for x in moments]
        factor = self._reals[ints[AT] + looks.FACTORS + ints[TAKEN]]
        ints[TAKEN] += 1
        self.errors.append(looks.widest(self.states, width, self._many, factor))
        seen = self.states + self._out[self._end : self._end + width].tolist()
        self.need = looks.needed(seen, width, self._many, self._end)
        if not self.reached():
            left = ints[SIZES] - ints[NEXT]
            ints[NEXT] += looks.stride(self.errors[-1], self._target * self._fall, left)

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
    """What `looks.climb` gets as ints, the sizes of all looks, how many of them are near, and the
    factors of their widths."""
    last = min(1 << MOST[points], SETS[points][0])
    first = FIRST_FINE if fine else FIRST
    start = (LATTICES_FINE if fine else LATTICES) if points == "lattice" else (first,)
    sizes = (*start, *(1 << k for k in range(start[-1].bit_length(), last.bit_length())))
    sizes = tuple(size for size in sizes if size >= fewest) or (last,)
    ints = [0, 0, many, 0, 0, *NONE, at, 0, 0, 0, len(sizes)]
    assert len(ints) == TABLE
    for size in sizes:
        ints += (size, *(SHAPES[points](size) if points in SHAPES else NONE))
    near = sum(size * many <= NEAR for size in sizes)
    packed = bytes((ctypes.c_uint64 * len(ints))(*ints))
    return packed, sizes, near, looks.factors(many, len(sizes))
