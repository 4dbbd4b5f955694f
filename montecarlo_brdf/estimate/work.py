"""Running a kernel over replicates and samples: cut into calls, spread over threads, merged.

The cut never shows in the result: samples are taken in chunks of fixed size, each from a zero
state, and merged in a fixed order whatever thread computed them. Memory does not grow with the
number of samples, and no call lasts long enough to make Ctrl-C wait: a kernel carries its state on
from call to call, so slow ones are cut into as many calls as they need, down to single blocks.
"""
from __future__ import annotations

import ctypes
import itertools
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.compile.kernel import Kernel
from montecarlo_brdf.estimate.moments import BLOCK, STATE
from montecarlo_brdf.sampling.points import NONE, Shape
from montecarlo_brdf.statistics import Moments, merged

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

CHUNK = 1 << 17
LONGEST = 0.1  # seconds that a call should take at most
Progress = Callable[[float], None]


class Job(NamedTuple):
    """What to compute: `samples` points in each of `replicates` randomisations of one stream."""

    kernel: Kernel
    reals: Sequence[float]
    width: int  # numbers of results: channels times integrands
    key: int
    replicates: int
    samples: int
    shape: Shape = NONE  # of the point set


class Call(NamedTuple):
    """One kernel call: samples [start, start + count) of replicates [first, first + many)."""

    first: int
    many: int
    start: int
    count: int  # type: ignore[assignment]  # hides tuple.count, which nobody asks a call for


def run(
    job: Job,
    threads: int = 1,
    progress: Progress | None = None,
    sums: PartialSums | None = None,
) -> list[list[Moments]]:
    """Moments per result and replicate: run(job)[result][replicate].

    sums: where a long job's partial sums are kept, and taken up again.
    """
    if job.replicates * job.samples <= CHUNK:
        return _whole(job, progress)
    begun = sums.begun(job) if sums else None
    done, stacks = begun or (0, [[[] for _ in range(job.replicates)] for _ in range(job.width)])
    rest = itertools.islice(calls(job), done, None)
    for call, states in _outcomes(job, rest, threads):
        for r in range(call.many):
            for k in range(job.width):
                _push(stacks[k][call.first + r], states[r * job.width + k])
        done += 1
        if sums:
            sums.keep(job, done, stacks)
        if progress:
            progress((call.first * job.samples + call.many * (call.start + call.count))
                     / (job.replicates * job.samples))  # fmt: skip
    return [[_total(stack) for stack in row] for row in stacks]


def _whole(job: Job, progress: Progress | None) -> list[list[Moments]]:
    """A small job in a single call: its overhead is what adaptive estimates feel."""
    states = _call(job, Call(0, job.replicates, 0, job.samples))
    if progress:
        progress(1.0)
    return [states[k :: job.width] for k in range(job.width)]


def calls(job: Job) -> Iterator[Call]:
    """All calls of a job: many small replicates in one, or one large replicate in many."""
    many = max(1, CHUNK // job.samples)
    for first in range(0, job.replicates, many):
        for start in range(0, job.samples, CHUNK):
            yield Call(
                first, min(many, job.replicates - first), start, min(CHUNK, job.samples - start)
            )


def _outcomes(
    job: Job, queue: Iterator[Call], threads: int
) -> Iterator[tuple[Call, list[Moments]]]:
    """The calls with their results, in order; a bounded number is under way at any time."""
    if threads == 1:
        yield from ((c, _call(job, c)) for c in queue)
        return
    with ThreadPoolExecutor(threads) as pool:
        while batch := list(itertools.islice(queue, 16 * threads)):
            yield from zip(batch, pool.map(lambda c: _call(job, c), batch), strict=True)


def _call(job: Job, call: Call) -> list[Moments]:
    ladder = Ladder(job.kernel, job.reals, job.width, job.key, call.many, call.first)
    states = ladder.states(call.count, job.shape, call.start)
    return [Moments(*states[i : i + STATE]) for i in range(0, len(states), STATE)]


class Ladder:
    """A stream of one kernel at one query, asked for ever more samples: arrays are made once."""

    def __init__(
        self,
        kernel: Kernel,
        reals: Sequence[float],
        width: int,
        key: int,
        replicates: int,
        first: int = 0,
    ) -> None:
        self._kernel = kernel
        self._ints = (ctypes.c_int64 * 10)(key, first, replicates)  # ctypes wraps the key's sign
        self._reals = (ctypes.c_double * len(reals))(*reals)
        self._out = ctypes.c_double * (STATE * width * replicates)
        self._at = ctypes.addressof(self._ints), ctypes.addressof(self._reals)
        self._first, self._replicates = first, replicates
        self._stride = 8 * STATE * width  # bytes of a replicate's states

    def states(self, count: int, shape: Shape = NONE, start: int = 0) -> list[float]:
        """STATE numbers per replicate and result, of samples [start, start + count)."""
        out = self._out()
        at = ctypes.addressof(out)
        self._ints[5:] = list(shape)
        for skipped, many, done, size in self._pieces(count):
            self._ints[1:5] = [self._first + skipped, many, start + done, size]
            began = time.perf_counter()
            self._kernel(*self._at, at + skipped * self._stride)
            self._kernel.timed(many * size, time.perf_counter() - began)
        return out[:]

    def _pieces(self, count: int) -> Iterator[tuple[int, int, int, int]]:
        """(replicates before, replicates, samples before, samples) of each call: whole replicates,
        or whole blocks of one, as many as the pace of the call before allows."""
        skipped = 0
        while skipped < self._replicates:
            many = min(self._replicates - skipped, self._affordable() // count)
            if many:
                yield skipped, many, 0, count
            done = count if many else 0
            while done < count:
                size = min(count - done, self._affordable() // BLOCK * BLOCK)
                yield skipped, 1, done, size
                done += size
            skipped += max(1, many)

    def _affordable(self) -> int:
        """Samples of a call that is not too long; one block as long as nothing is known."""
        return max(BLOCK, self._kernel.affordable(LONGEST, BLOCK))


def _push(stack: list[tuple[int, Moments]], moments: Moments) -> None:
    """Pairwise summation of a stream: equal ranks merge, as carries do in binary counting."""
    rank = 0
    while stack and stack[-1][0] == rank:
        moments = merged([stack.pop()[1], moments])
        rank += 1
    stack.append((rank, moments))


def _total(stack: list[tuple[int, Moments]]) -> Moments:
    total = stack[-1][1]
    for _, moments in reversed(stack[:-1]):
        total = merged([moments, total])
    return total
