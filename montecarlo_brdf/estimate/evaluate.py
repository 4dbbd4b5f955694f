"""Integrands evaluated for a subject by a plan: kernels called, their work spread over threads and
merged.

The cut never shows in the result: samples are taken in chunks of fixed size, each from a zero
state, and merged in a fixed order whatever thread computed them. Memory does not grow with the
number of samples, and no call lasts long enough to make Ctrl-C wait: a kernel carries its state on
from call to call, so slow ones are cut into as many calls as they need, down to single blocks.
"""
from __future__ import annotations

import ctypes
import itertools
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.compile.kernel import Kernel
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate import moments
from montecarlo_brdf.estimate.moments import BLOCK, STATE
from montecarlo_brdf.estimate.plan import Plan, check_points, check_samples
from montecarlo_brdf.estimate.quantity import Integrand
from montecarlo_brdf.estimate.samplers import Subject, query, subject_of
from montecarlo_brdf.model import Model, ParameterSet
from montecarlo_brdf.sampling.points import NONE, SETS, SHAPES, PointSet, Shape, stream
from montecarlo_brdf.statistics import Estimate, Moments, estimate, merged
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

CHUNK = 1 << 17
LONGEST = 0.1  # seconds that a call should take at most


def estimates(
    model: Model,
    p: ParameterSet,
    fixed: Vec,
    integrands: Sequence[Integrand],
    plan: Plan,
    label: tuple[object, ...],
) -> list[list[Estimate]]:
    """Estimates of several integrands on the same points: result[channel][integrand]."""
    return evaluate(subject_of(model, p), query(model, p, fixed), integrands, plan, label)


def evaluate(
    subject: Subject,
    fixed: Sequence[float],
    integrands: Sequence[Integrand],
    plan: Plan,
    label: tuple[object, ...],
    common: bool = False,
) -> list[list[Estimate]]:
    """The same for any subject; `label` names the stream with it.

    common: the same random numbers for every direction, so that what is searched is smooth.
    """
    check_samples(plan.samples)
    check_points(plan.points)
    replicates = max(1, min(plan.replicates, plan.samples))
    per_replicate = _per_replicate(plan, replicates)
    place = () if common else fixed
    key = stream(plan.seed, plan.points, *subject.identity, *label, *place)
    suited = [i.for_lattice() if plan.points == PointSet.LATTICE else i for i in integrands]
    together = max(1, 16 // len(suited))  # channels that share a kernel: what fits a small stack
    rows = []
    for first in range(0, len(subject.sets), together):
        group = subject.sets[first : first + together]
        layout, numbers = pack(group, moments.QUERY)
        kernel = moments.kernel_of(subject.name, plan.points, suited, layout)
        width = len(group) * len(suited)
        reals = (*(*fixed, 0.0)[: moments.QUERY], *numbers)
        shape = SHAPES[plan.points](per_replicate) if plan.points in SHAPES else NONE
        job = Job(kernel, reals, width, key, replicates, per_replicate, shape)
        results = [estimate(m) for m in run(job, plan.threads, plan.sums)]
        rows += [results[i : i + len(suited)] for i in range(0, width, len(suited))]
    return rows


def _per_replicate(plan: Plan, replicates: int) -> int:
    """Samples in each replicate, rounded up to what the point set needs."""
    each = -(-plan.samples // replicates)
    most, power_of_two = SETS[plan.points]
    each = 1 << (each - 1).bit_length() if power_of_two else each
    if each > most:
        raise UserError(f"{plan.points} points allow {most} samples per replicate, not {each}")
    return each


class Call(NamedTuple):
    """One kernel call: samples [start, start + count) of replicates [first, first + many)."""

    first: int
    many: int
    start: int
    count: int  # type: ignore[assignment]  # hides tuple.count, which nobody asks a call for


class Job(NamedTuple):
    """What to compute: `samples` points in each of `replicates` randomisations of one stream."""

    kernel: Kernel
    reals: Sequence[float]
    width: int  # numbers of results: channels times integrands
    key: int
    replicates: int
    samples: int
    shape: Shape = NONE  # of the point set

    def calls(self) -> Iterator[Call]:
        """All calls: many small replicates in one, or one large replicate in many."""
        many = max(1, CHUNK // self.samples)
        for first in range(0, self.replicates, many):
            together = min(many, self.replicates - first)
            for start in range(0, self.samples, CHUNK):
                yield Call(first, together, start, min(CHUNK, self.samples - start))

    def states(self, call: Call) -> list[float]:
        """STATE numbers per replicate and result of a call."""
        ints = (ctypes.c_int64 * 10)(self.key, 0, 0, 0, 0, *self.shape)  # wraps the key's sign
        reals = (ctypes.c_double * len(self.reals))(*self.reals)
        out = (ctypes.c_double * (STATE * self.width * call.many))()
        at = [ctypes.addressof(a) for a in (ints, reals, out)]
        stride = ctypes.sizeof(out) // call.many
        for skipped, many, done, size in pieces(self.kernel, call.many, call.count):
            ints[1:5] = [call.first + skipped, many, call.start + done, size]
            began = time.perf_counter()
            self.kernel(at[0], at[1], at[2] + skipped * stride)
            self.kernel.timed(many * size, time.perf_counter() - began)
        return out[:]

    def moments(self, call: Call) -> list[Moments]:
        """The same as moments, all results of a replicate side by side."""
        states = self.states(call)
        return [Moments(*states[i : i + STATE]) for i in range(0, len(states), STATE)]


def pieces(kernel: Kernel, replicates: int, count: int) -> Iterator[tuple[int, int, int, int]]:
    """(replicates before, replicates, samples before, samples) of each piece of a call that is not
    too long by the pace of the one before: whole replicates, or whole blocks of one."""

    def affordable() -> int:
        return max(BLOCK, kernel.affordable(LONGEST, BLOCK))

    skipped = 0
    while skipped < replicates:
        many = min(replicates - skipped, affordable() // count)
        if many:
            yield skipped, many, 0, count
        done = count if many else 0
        while done < count:
            size = min(count - done, affordable() // BLOCK * BLOCK)
            yield skipped, 1, done, size
            done += size
        skipped += max(1, many)


def run(job: Job, threads: int = 1, sums: PartialSums | None = None) -> list[list[Moments]]:
    """Moments per result and replicate: run(job)[result][replicate].

    sums: where a long job's partial sums are kept, and taken up again.
    """
    if job.replicates * job.samples <= CHUNK:  # in one call: adaptive estimates feel its overhead
        states = job.moments(Call(0, job.replicates, 0, job.samples))
        return [states[k :: job.width] for k in range(job.width)]
    begun = sums.begun(job) if sums else None
    done, stacks = begun or (0, [[[] for _ in range(job.replicates)] for _ in range(job.width)])
    rest = itertools.islice(job.calls(), done, None)
    for call, states in _outcomes(job, rest, threads):
        for r in range(call.many):
            for k in range(job.width):
                _push(stacks[k][call.first + r], states[r * job.width + k])
        done += 1
        if sums:
            sums.keep(job, done, stacks)
    return [[_total(stack) for stack in row] for row in stacks]


def _outcomes(
    job: Job, queue: Iterator[Call], threads: int
) -> Iterator[tuple[Call, list[Moments]]]:
    """The calls with their results, in order; a bounded number is under way at any time."""
    if threads == 1:
        yield from ((c, job.moments(c)) for c in queue)
        return
    with ThreadPoolExecutor(threads) as pool:
        while batch := list(itertools.islice(queue, 16 * threads)):
            yield from zip(batch, pool.map(job.moments, batch), strict=True)


def _push(stack: list[tuple[int, Moments]], moments: Moments) -> None:
    """Pairwise summation of a stream: equal ranks merge, as carries do in binary counting."""
    rank = 0
    while stack and stack[-1][0] == rank:
        moments = merged([stack.pop()[1], moments])
        rank += 1
    stack.append((rank, moments))


def _total(stack: list[tuple[int, Moments]]) -> Moments:
    total = stack[-1][1]
    for _, earlier in reversed(stack[:-1]):
        total = merged([earlier, total])
    return total
