"""What a model's sampler does at the ends of its numbers, where few draws fall and much may happen.

Looked at by plain Python calls, in cells that halve towards 0 and 1 of u[0] and of u[1], down to
2^-OCTAVES, which a million random numbers may never meet.
"""
from __future__ import annotations

import math
import numbers
from typing import Any, NamedTuple

from montecarlo_brdf.estimate.probe import called, number_from
from montecarlo_brdf.model import Model
from montecarlo_brdf.vectors import Vec

#: cells towards each end of a number, and values of the other number in each
OCTAVES, ACROSS = 24, 8
GOLDEN = 0.6180339887498949  # the fraction of the golden ratio: its multiples never cluster


class Ends(NamedTuple):
    """Of rows of cells towards an end, all other numbers fixed: cell k holds 2^-(k + 2) of all."""

    rejected: float = 0.0  # share of the draws that lie below the horizon, to a factor of 2
    weights: tuple[tuple[float, ...], ...] = ()  # f cos/pdf over its mean, ACROSS rows for each end

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


def at_ends(model: Model, ready: Any, wo: Vec) -> Ends:
    """The ends of the model's sampler, nothing without one."""
    if model.sample is None:
        return Ends()
    rejected, weights, mean = [], [], 0.0
    for axis in (0, 1):
        rows = [_row(model, ready, wo, axis, end, j) for end in (0, 1) for j in range(ACROSS)]
        rejected.append(_mean([[float(w is None) for w in row] for row in rows]))
        weights += [[w or 0.0 for w in row] for row in rows]
        mean += 0.5 * _mean(weights[-len(rows) :])
    scale = 1.0 / mean if mean > 0.0 else math.nan
    return Ends(max(rejected), tuple(tuple(scale * w for w in row) for row in weights))


def _mean(rows: list[list[float]]) -> float:
    """Over all cells of a number where the value is known."""
    cells = [0.25 * 0.5**k * x for row in rows for k, x in enumerate(row) if math.isfinite(x)]
    return sum(cells) / ACROSS


def _row(model: Model, ready: Any, wo: Vec, axis: int, end: int, j: int) -> list[float | None]:
    """Weights towards an end of a number, None for a rejected draw."""
    places = (abs(end - 0.375 * 0.5**k) for k in range(OCTAVES))
    return [_weight(model, ready, wo, _numbers(axis, t, j)) for t in places]


def _numbers(axis: int, t: float, j: int) -> Vec:
    s, third = (j + 0.5) / ACROSS, math.modf(0.5 + j * GOLDEN)[0]
    return (s, t, third) if axis else (t, s, third)


def _weight(model: Model, ready: Any, wo: Vec, u: Vec) -> float | None:
    """f cos/pdf of a draw, None below the horizon, NaN where it has none."""
    w = called(model, "sample", model.sample, wo, u, ready)
    if not (isinstance(w, tuple) and all(isinstance(c, numbers.Real) for c in w)):
        return math.nan
    if w[2] <= 0.0:
        return None
    if len(w) == 4:
        return float(w[3])
    if model.pdf is None:
        return math.nan
    pdf = number_from(model, "pdf", model.pdf, wo, w, ready)
    f = number_from(model, "f", model.f, wo, w, ready)
    return f * float(w[2]) / pdf if pdf else math.nan


def _variance(tail: tuple[float, ...]) -> float:
    """Of weights in cells of which each holds half as many draws as the one before."""
    share = [0.5**k for k in range(len(tail))]
    mean = sum(s * w for s, w in zip(share, tail, strict=True)) / sum(share)
    return sum(s * (w - mean) ** 2 for s, w in zip(share, tail, strict=True)) / sum(share)
