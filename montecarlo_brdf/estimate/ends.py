"""What a model's sampler does at the ends of its numbers, where few draws fall and much may happen.

Looked at in cells that halve towards 0 and 1 of u[0] and of u[1], down to 2^-OCTAVES, which a
million random numbers may never meet.
"""
from __future__ import annotations

import functools
import itertools
import math
from array import array
from typing import NamedTuple

from montecarlo_brdf.compile.bind import Ints, Out, Reals, hole
from montecarlo_brdf.compile.kernel import kernel
from montecarlo_brdf.compile.layout import Unpack, pack
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import functions_of, integrand, samplers_of
from montecarlo_brdf.model import Model, Prepared
from montecarlo_brdf.sampling.charts import Row
from montecarlo_brdf.sampling.directions import Given, Sampler
from montecarlo_brdf.statistics import SAME
from montecarlo_brdf.vectors import Vec

PARAMETERS = SAMPLE = INTEGRAND = hole()

#: cells towards each end of a number, and values of the other number in each
OCTAVES, ACROSS = 24, 8
MIDDLE = 0.375  # of the first cell, from 1/4 to 1/2
GOLDEN = 0.6180339887498949  # the fraction of the golden ratio: its multiples never cluster
#: the share of the draws in each cell, of half of them
SHARES = tuple(0.5**k for k in range(OCTAVES))
ROWS = 4 * ACROSS  # of cells: towards both ends of two numbers


class Ends(NamedTuple):
    """Of rows of cells towards an end, all other numbers fixed: cell k holds 2^-(k + 2) of all."""

    rejected: float = 0.0  # share of the draws that lie below the horizon, to a factor of 2
    weights: tuple[tuple[float, ...], ...] = ()  # f cos/pdf over its mean, rows in which it varies

    def spread(self, samples: float) -> float:
        """What the draws nearest to the ends add to the relative error of a mean over points of
        which one lies in each of `samples` slices of every number.

        A weight like a logarithm at an end makes most of the error there, and spreads it like an
        exponential: means of few randomisations often miss it all together.
        """
        half = int(math.log2(samples)) - 1  # the cell that is half of the last slice
        first = min(max(0, half), OCTAVES - 1)
        variances = [_variance(row[first:]) for row in self.weights]
        return math.sqrt(sum(v for v in variances if math.isfinite(v)) / ACROSS) / samples


def weights(ints: Ints, reals: Reals, out: Out) -> None:
    """out[2 j], out[2 j + 1] = cos and f cos/pdf of the draw for u_j.

    ints = (n, place of wo), after which stand the numbers.
    """
    p, at = PARAMETERS(reals)[0], ints[1]
    given = (reals[at], reals[at + 1], reals[at + 2], 0.0)
    for j in range(ints[0]):
        k = at + 3 + 3 * j
        u = (reals[k], reals[k + 1], 0.0, 0.0, reals[k + 2], 0.0, 0.0, 0.0)
        out[2 * j] = SAMPLE(given[:3], (u[0], u[1], u[4]), p)[2]
        out[2 * j + 1] = INTEGRAND(u, given, p)


def at_ends(model: Model, ready: Prepared, wo: Vec) -> Ends:
    """The ends of the model's sampler, nothing without one; ready: prepared parameters."""
    if model.sample is None:
        return Ends()
    rows = _rows(model, ready, wo)
    lost = [[float(z <= 0.0) for z, _ in row] for row in rows]
    found = [[0.0 if z <= 0.0 else x for z, x in row] for row in rows]
    half = len(rows) // 2  # of each number
    mean = 0.5 * (_mean(found[:half]) + _mean(found[half:]))
    scale = 1.0 / mean if mean > 0.0 else math.nan
    varying = [row for row in found if not max(row) - min(row) <= SAME * mean]
    weights = tuple(tuple(scale * x for x in row) for row in varying)
    return Ends(max(_mean(lost[:half]), _mean(lost[half:])), weights)


def _rows(model: Model, ready: Prepared, wo: Vec) -> list[list[tuple[float, float]]]:
    """(cos, weight) in the cells of each row."""
    layout, numbers = pack([ready], 0)
    known = Sampler.OWN in samplers_of(model)
    weight = integrand(model, Quantity.ALBEDO, Sampler.OWN).template if known else unknown
    sample = functions_of(model)["SAMPLE"]
    names = {"SAMPLE": sample, "PARAMETERS": Unpack(layout), "INTEGRAND": weight}
    n = ROWS * OCTAVES
    ints = array("q", (n, len(numbers)))
    reals = array("d", (*numbers, *wo, *_numbers()))
    out = array("d", bytes(16 * n))
    kernel(model.name, weights, **names)(*(a.buffer_info()[0] for a in (ints, reals, out)))
    pairs = list(zip(out[::2], out[1::2], strict=True))
    return [pairs[k : k + OCTAVES] for k in range(0, n, OCTAVES)]


def unknown(u: Row, given: Given, p: Prepared) -> float:
    """The weight where nothing tells it."""
    return math.nan


@functools.cache
def _numbers() -> array[float]:
    """u[0], u[1], u[2] of every cell."""
    numbers = array("d")
    for axis, end, j, share in itertools.product((0, 1), (0, 1), range(ACROSS), SHARES):
        t, s = abs(end - MIDDLE * share), (j + 0.5) / ACROSS
        numbers.extend((*((s, t) if axis else (t, s)), math.modf(0.5 + j * GOLDEN)[0]))
    return numbers


def _mean(rows: list[list[float]]) -> float:
    """Over all cells of a number where the value is known."""
    known = [s * x for row in rows for s, x in zip(SHARES, row, strict=True) if math.isfinite(x)]
    return 0.25 * sum(known) / ACROSS


def _variance(tail: tuple[float, ...]) -> float:
    """Of weights in cells of which each holds half as many draws as the one before."""
    share = SHARES[: len(tail)]
    mean = sum(s * w for s, w in zip(share, tail, strict=True)) / sum(share)
    return sum(s * (w - mean) ** 2 for s, w in zip(share, tail, strict=True)) / sum(share)
