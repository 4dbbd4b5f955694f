"""Some cells again, by a method that shares nothing with the first but f: an adaptive quadrature.

What both miss nobody sees; what one misses shows here, and no certificate of the table is then
worth anything.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.table.axes import points, said
from montecarlo_brdf.table.cell import Terms, integrated
from montecarlo_brdf.table.cells import Cells
from montecarlo_brdf.table.subject import Measure, Subject

SPOTS = 8


class Spot(NamedTuple):
    """Two numbers of one cell, and by how much their intervals miss each other, at most 0 if they
    do not."""

    measure: Measure
    where: dict[str, float]
    value: float
    other: float
    apart: float


def spots(subject: Subject, terms: Terms, cells: Cells) -> list[Spot]:
    """The worst spot of each measure over some cells at random and the first and last; none of
    averages, which the quadrature does not know."""
    if Measure.AVERAGE in subject.measures:
        return []
    places = list(points(subject.axes))
    rng = np.random.default_rng(stream(terms.seed, subject.model.identity, "spots"))
    some = {0, len(places) - 1, *rng.integers(len(places), size=SPOTS - 2).tolist()}
    values = cells.values.reshape(len(subject.measures), -1)
    errors = cells.errors.reshape(len(subject.measures), -1)
    found: list[list[Spot]] = [[] for _ in subject.measures]
    for k in sorted(some):
        place = subject.place(places[k])
        other = integrated(subject, place, subject.weights(), terms, sure=False)
        for m, measure in enumerate(subject.measures):
            apart = abs(other.values[m] - values[m, k]) - other.errors[m] - errors[m, k]
            found[m].append(Spot(measure, said(subject.axes, places[k]), float(values[m, k]),
                                 other.values[m], float(apart)))  # fmt: skip
    return [max(row, key=lambda s: s.apart) for row in found]
