"""Looks at more and more samples in a single compiled call: what adaptive estimates consist of.

A look at N samples per replicate spends its share of the error level on the interval of its
replicates. `climb` is a template: its capitalised names are bound to kernels of the same model.
"""
from __future__ import annotations

import functools
import math
from typing import Any

from montecarlo_brdf import student
from montecarlo_brdf.compile.kernel import Kernel, kernel
from montecarlo_brdf.compile.layout import Layout
from montecarlo_brdf.compile.reach import hole
from montecarlo_brdf.estimate.moments import STATE, template_of
from montecarlo_brdf.estimate.quantity import Integrand
from montecarlo_brdf.sampling.directions import PROBES
from montecarlo_brdf.statistics import FLOOR

LEVEL = 0.01  # of the interval that must be below the target, over all looks
SHARE = 0.25  # largest share of a replicate's total that a probed value may have

#: places in `ints` after those of `moments`: (place of the target in reals, sizes that this call
#: may take, index of the next size, looks taken, sizes in the table), then COLUMNS per size
AT, STOP, NEXT, TAKEN, SIZES, TABLE = 10, 11, 12, 13, 14, 15
COLUMNS = 6  # samples of a replicate and the shape of the point set
#: places in `reals` from the target on: (target, fewest samples, need that ends it, how much an
#: error may fall from one size to the next), then a factor for each look
FEWEST, HOPELESS, FALL, FACTORS = 1, 2, 3, 4

MOMENTS: Any = hole()
HIGHEST: Any = hole()
PROBED: Any = hole()  # how many directions, 0 for none
CHANNELS: Any = hole()


def climb(ints: Any, reals: Any, out: Any) -> None:
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
        ints[NEXT] += stride(worst, reals[at] * reals[at + FALL], ints[SIZES] - ints[NEXT])


def stride(worst: float, reachable: float, left: int) -> int:
    """Sizes to go on by: no look is spent where the target cannot be; the last is not skipped."""
    return 2 if worst > reachable and left > 2 else 1


def widest(states: Any, width: int, count: int, factor: float) -> float:
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


def needed(states: Any, width: int, count: int, end: int) -> float:
    """Samples that the probed values at states[end...] demand, beside the means."""
    need = 0.0
    for k in range(width):
        mean = 0.0
        for r in range(count):
            mean += states[(r * width + k) * STATE + 1]
        size, high = SHARE * abs(mean) / count, states[end + k]
        need = max(need, high / size if size > 0.0 else (math.inf if high > 0.0 else 0.0))
    return need


def kernel_of(
    model: str, points: str, mean: Integrand, probe: Integrand | None, layout: Layout
) -> Kernel:
    """The kernel of an adaptive estimate: a mean, and how to probe its integrand if at all."""
    means = template_of(points, [mean], layout)
    highest = template_of("counted", [probe], layout) if probe else means
    return kernel(
        model,
        climb,
        MOMENTS=means,
        HIGHEST=highest,
        PROBED=PROBES if probe else 0,
        CHANNELS=len(layout.places),
    )


@functools.cache
def factors(replicates: int, looks: int) -> tuple[float, ...]:
    """Half-width of each look over the root of the sum of squared deviations of the means."""
    scale = math.sqrt(replicates * (replicates - 1))
    return tuple(
        student.quantile(0.5 * LEVEL * 0.5 ** (k + 1), replicates - 1) / scale
        for k in range(looks)
    )
