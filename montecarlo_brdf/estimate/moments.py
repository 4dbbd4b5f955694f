"""The inner loop: mean and spread of integrands over a point set, for K parameter sets at once.

`moments` is a template: `kernel_of` binds it to a point set, integrands and an unpacker of
parameters; the result is compiled per model. Samples are taken in blocks of fixed size that are
merged in fixed order, so that results do not depend on how the work is cut into calls or on the
number of threads. Points of a block are made before integrands are evaluated: in one loop their
dependent operations add up to a chain that a processor with few vector registers waits for (a third
of the time of GGX, half of Beckmann's). Where all integrands want the same direction of a point, it
is made before too, in up to three steps, each in a loop of its own. Coordinates that no integrand
reads are never made.
"""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from montecarlo_brdf.bits import smaller, u64
from montecarlo_brdf.compile.bind import Bound, Function, Ints, Out, Reals, bound, hole
from montecarlo_brdf.compile.kernel import Kernel, kernel
from montecarlo_brdf.compile.layout import Buffer, Layout, Numbers, Unpack
from montecarlo_brdf.estimate.quantity import Integrand
from montecarlo_brdf.sampling import points as point_sets
from montecarlo_brdf.sampling.charts import Row
from montecarlo_brdf.sampling.directions import Given
from montecarlo_brdf.sampling.points import NONE, replicate_key

BLOCK = 512
#: numbers from one row of a block to the next: a power of two would have all rows compete for the
#: same lines of the cache
ROOM = BLOCK + 8
#: reals before the parameters: the fixed direction (x, y, z) and one number for the integrand
QUERY = 4
#: numbers kept per replicate and channel: count, mean, sum of squared deviations, largest x
STATE = 4

POINTS = SHAPE = STORE = PARAMETERS = BUFFER = ROW = hole()
STEP = STEP_ONE = STEP_TWO = STEP_THREE = hole()
STEPS = hole()  # how many of these are taken
FIRST = SECOND = THIRD = FOURTH = FIFTH = hole()
CHANNELS = hole()  # parameter sets
SLOTS = hole()  # integrands
#: what a kernel calls its integrands
NAMES = ("FIRST", "SECOND", "THIRD", "FOURTH", "FIFTH")


def moments(ints: Ints, reals: Reals, out: Out) -> None:
    """Add samples [start, start + count) of replicates [first, first + many) to `out`.

    ints = (key, first, many, start, count, shape of the point set); reals = query and parameters;
    out holds STATE numbers per replicate, channel and integrand, all zero before the first call.
    """
    shape = SHAPE(ints)
    query = (reals[0], reals[1], reals[2], reals[3])
    parameters = PARAMETERS(reals)
    u = (ROW(), ROW(), ROW(), ROW(), ROW(), ROW(), ROW(), ROW())
    w = (ROW(), ROW(), ROW(), ROW(), ROW(), ROW(), ROW(), ROW())
    x = BUFFER()
    stop = ints[3] + ints[4]
    for r in range(ints[2]):
        key = replicate_key(u64(ints[0]), ints[1] + r)
        i = ints[3]
        while i < stop:
            m = BLOCK if stop - i > BLOCK else stop - i
            for j in range(m):
                u[0][j], u[1][j], u[2][j], u[3][j], u[4][j] = POINTS(key, u64(i + j), shape)
            if STEPS > 0:
                STEP_ONE(u, w, m, query)
            if STEPS > 1:
                STEP_TWO(w, w, m, query)
            if STEPS > 2:
                STEP_THREE(w, w, m, query)
            for j in range(m):
                point = row(w, j) if STEPS > 0 else row(u, j)
                for k in range(CHANNELS):
                    STORE(point, query, parameters[k], x, k * SLOTS * ROOM + j)
            for k in range(CHANNELS * SLOTS):
                merge_block(x, k * ROOM, m, out, (r * CHANNELS * SLOTS + k) * STATE)
            i += m


def row(rows: Sequence[Reals], j: int) -> Row:
    """The numbers of point j."""
    return (
        rows[0][j], rows[1][j], rows[2][j], rows[3][j],
        rows[4][j], rows[5][j], rows[6][j], rows[7][j],
    )  # fmt: skip


def advance(source: Sequence[Reals], target: Sequence[Out], m: int, query: Given) -> None:
    """Take one step for all points of a block."""
    for j in range(m):
        (
            target[0][j], target[1][j], target[2][j], target[3][j],
            target[4][j], target[5][j], target[6][j], target[7][j],
        ) = STEP(row(source, j), query)  # fmt: skip


def as_made(u: Row, given: Given) -> Row:
    """In place of a step that is not needed."""
    return u


def shaped(ints: Ints) -> Any:
    """The shape of a point set that has one."""
    return u64(ints[5]), u64(ints[6]), u64(ints[7]), u64(ints[8]), u64(ints[9])


def shapeless(ints: Ints) -> Any:
    """In place of the shape for point sets that need none: quicker to compile."""
    return NONE


def store(u: Row, query: Given, p: Numbers, x: Out, at: int) -> None:
    """Evaluate the integrands, each into its slot of the block.

    One function for up to five: the compiler drops what SLOTS excludes, and a chain of functions
    would take it longer.
    """
    x[at] = FIRST(u, query, p)
    if SLOTS > 1:
        x[at + ROOM] = SECOND(u, query, p)
    if SLOTS > 2:
        x[at + 2 * ROOM] = THIRD(u, query, p)
    if SLOTS > 3:
        x[at + 3 * ROOM] = FOURTH(u, query, p)
    if SLOTS > 4:
        x[at + 4 * ROOM] = FIFTH(u, query, p)


def merge_block(x: Reals, start: int, m: int, out: Out, at: int) -> None:
    """Merge x[start : start + m] into the state at out[at].

    Values are taken from the first one, so a constant has exactly zero spread (and not the first
    from them: an operand in memory is free only as the one taken away). Blocks merge by Chan,
    Golub, LeVeque 1979, which stays exact where the one-pass formula cancels.
    """
    origin = x[start]
    total = 0.0
    squares = 0.0
    least = 0.0
    for j in range(m):
        d = origin - x[start + j]
        total += d
        squares += d * d
        least = smaller(d, least)
    count = out[at]
    merged = count + m
    shift = origin - total / m - out[at + 1]
    out[at] = merged
    out[at + 1] += shift * (m / merged)
    out[at + 2] += (squares - total * total / m) + shift * (shift * (count * m / merged))
    largest = origin - least
    out[at + 3] = out[at + 3] if largest <= out[at + 3] else largest


def kernel_of(model: str, points: str, integrands: Sequence[Integrand], layout: Layout) -> Kernel:
    """The kernel of means of up to five integrands of a model."""
    return kernel(model, moments, **_names(points, integrands, layout))


def template_of(points: str, integrands: Sequence[Integrand], layout: Layout) -> Bound:
    """The same for other templates to call."""
    return bound(moments, **_names(points, integrands, layout))


def _names(points: str, integrands: Sequence[Integrand], layout: Layout) -> dict[str, object]:
    first, *others = {i.steps for i in integrands}
    steps = () if others else first  # if all want the same of them and no more
    channels, slots = len(layout.places), len(integrands)
    return {
        "POINTS": _point_set(points, integrands),
        "STEPS": len(steps),
        **_advances(steps),
        "SHAPE": shaped if points in point_sets.SHAPES else shapeless,
        "STORE": _store(integrands, bool(steps)),
        "PARAMETERS": Unpack(layout),
        "BUFFER": Buffer(ROOM * channels * slots),
        "ROW": Buffer(ROOM),
        "CHANNELS": channels,
        "SLOTS": slots,
    }


def _point_set(points: str, integrands: Sequence[Integrand]) -> Function:
    """The points; of Sobol's only the coordinates that the integrands use."""
    used = max(i.coordinates for i in integrands)
    if points == point_sets.PointSet.SOBOL and used < point_sets.DIMENSIONS:
        return point_sets.sobol_plane if used > 2 else point_sets.sobol_pair
    found: Function = getattr(point_sets, points)
    return found


def _advances(steps: Sequence[Function]) -> dict[str, Bound]:
    """What takes each step for a block, and in place of those not needed something typed."""
    made = [bound(advance, STEP=step) for step in steps]
    spare = bound(advance, STEP=as_made)
    names = ("STEP_ONE", "STEP_TWO", "STEP_THREE")
    return dict(zip(names, [*made, *[spare] * (len(names) - len(made))], strict=True))


def _store(integrands: Sequence[Integrand], made: bool) -> Bound:
    """A function that evaluates each integrand into its own slot."""
    if len(integrands) > len(NAMES):
        raise ValueError(f"{len(integrands)} integrands in one kernel; {len(NAMES)} are allowed")
    slots = [i.made if made else i.template for i in integrands]
    spare = [slots[0]] * (len(NAMES) - len(slots))  # typed, never called
    return bound(store, SLOTS=len(slots), **dict(zip(NAMES, slots + spare, strict=True)))
