"""The values of one cell, with a certificate each: how far the truth is away at most.

An estimate by randomised points (`estimate.adaptive`) is taken if it gets there; its replicates
share their points over the channels, so that a difference of two has an error bar of its own. Where
it does not get there, an adaptive quadrature of f is asked.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import NamedTuple

from montecarlo_brdf.checks._truth import AIM, TARGET, covering, quadrature
from montecarlo_brdf.estimate import adaptive
from montecarlo_brdf.estimate.ascent import LEVEL
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import TARGETS, Choice, Plan
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand
from montecarlo_brdf.model import channels
from montecarlo_brdf.sampling.points import PointSet
from montecarlo_brdf.statistics import FLOOR, Estimate, quantile
from montecarlo_brdf.table.axes import Point
from montecarlo_brdf.table.subject import Measure, Place, Subject

#: looks that an estimate may end at: sizes of three methods; each spends a part of the level
LOOKS = 64
#: of every estimate: sixteen shifts of a lattice have longer tails than Student's t
REPLICATES = 32
AGAIN = 4  # times that a smaller error is asked for
SPARE = 0.7  # of the error allowed that is aimed at then
AVERAGE = tuple(range(14, 25, 2))  # log2 of the samples of an average


class Cell(NamedTuple):
    """Per measure the value and the most that it is off; infinite where nothing is known."""

    values: list[float]
    errors: list[float]

    @property
    def worst(self) -> float:
        """The largest error."""
        return max(self.errors)


class Terms(NamedTuple):
    """How well a cell is to be known."""

    target: float  # absolute error
    level: float  # chance that a cell's certificate does not hold
    seed: int = 0


def cell(subject: Subject, point: Point, terms: Terms) -> Cell:
    """The values at a place."""
    place, weights = subject.place(point), subject.weights()
    if Measure.AVERAGE in subject.measures:
        return _averaged(subject, place, weights, terms)
    found = _sampled(subject, place, weights, terms)
    if found.worst <= terms.target:
        return found
    other = integrated(subject, place, weights, terms)
    return other if other.worst < found.worst or not math.isfinite(found.worst) else found


def _sampled(
    subject: Subject, place: Place, weights: list[list[float]], terms: Terms
) -> Cell:
    """By points of randomised sets, more until the certificate is as small as wished."""
    low, high = TARGETS
    narrower = quantile(0.25 * LEVEL, REPLICATES - 1) / _widths(terms.level)
    asked, found = terms.target * narrower, Cell([], [math.inf])
    for _ in range(AGAIN):
        plan = Plan(points=PointSet.LATTICE, seed=terms.seed, method=Choice.AUTO,
                    replicates=REPLICATES,
                    target_error=min(max(asked, low), 0.5 * high))  # fmt: skip
        rows, reached = adaptive.albedo(subject.model, place.p, place.wo, plan)
        found = combined(rows, weights, terms.level)
        if not reached:
            return Cell(found.values, [math.inf] * len(found.errors))
        if found.worst <= terms.target:
            break
        asked *= SPARE * terms.target / found.worst if found.worst < math.inf else 0.1
    return found


def _widths(level: float) -> float:
    """Standard errors in half of an interval that may be any of the looks'."""
    return quantile(0.5 * level / LOOKS, REPLICATES - 1)


def _averaged(subject: Subject, place: Place, weights: list[list[float]], terms: Terms) -> Cell:
    """The mean over all views, twice as many points until it is known."""
    best = Cell([math.nan] * len(weights), [math.inf] * len(weights))
    model = subject.model.of(place.p)
    for method in adaptive.methods(model):
        mean = integrand(model, Quantity.BIHEMISPHERICAL, method.sampler)
        for log in AVERAGE:
            plan = Plan(points=method.points, samples=1 << log, seed=terms.seed,
                        replicates=REPLICATES)  # fmt: skip
            rows = estimates(model, place.p, (0.0, 0.0, 1.0), [mean], plan, ("average", log))
            found = combined([row[0] for row in rows], weights, terms.level)
            best = min(best, found, key=lambda c: c.worst)
            if best.worst <= terms.target:
                return best
    return best


def integrated(
    subject: Subject, place: Place, weights: list[list[float]], terms: Terms, sure: bool = True
) -> Cell:
    """By a quadrature of f; sure: with an error that also covers another one."""
    model, target = subject.model.of(place.p), min(TARGET, AIM * terms.target)
    found = []
    for one in channels(place.p):
        ask = functools.partial(quadrature, model, one, place.wo, False, target=target)
        found.append(covering(ask(seed=0), ask(seed=1)) if sure else ask(seed=0))
    values = [sum(w * one.value for w, one in zip(row, found, strict=True)) for row in weights]
    errors = [sum(abs(w) * one.error for w, one in zip(row, found, strict=True)) for row in weights]
    return Cell(values, [e if math.isfinite(e) else math.inf for e in errors])


def combined(rows: Sequence[Estimate], weights: list[list[float]], level: float) -> Cell:
    """Sums of channels, whose replicates have their points in common."""
    cells = [_combined(rows, row, level) for row in weights]
    return Cell([value for value, _ in cells], [error for _, error in cells])


def _combined(rows: Sequence[Estimate], row: list[float], level: float) -> tuple[float, float]:
    many = len(rows[0].replicates)
    parts = [
        math.fsum(w * e.replicates[k] for w, e in zip(row, rows, strict=True)) for k in range(many)
    ]
    mean = math.fsum(parts) / many
    if not math.isfinite(mean):
        return mean, math.inf
    error = _spread(parts, mean)
    for w, e in zip(row, rows, strict=True):  # what the spread of replicates does not show
        hidden = e.stderr if e.stderr > (1.0 + 1e-9) * _spread(e.replicates, e.mean) else 0.0
        error += abs(w) * max(hidden, FLOOR * abs(e.mean))
    return mean, _widths(level) * error


def _spread(parts: Sequence[float], mean: float) -> float:
    many = len(parts)
    return math.sqrt(math.fsum((x - mean) ** 2 for x in parts) / (many * (many - 1)))
