"""How far something that stands for a table is from the truth, and where it is farthest."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.table.axes import points
from montecarlo_brdf.table.cell import Terms
from montecarlo_brdf.table.cells import Cells, at
from montecarlo_brdf.table.fresh import Deviation, Fresh, Stand, climbed, deviations
from montecarlo_brdf.table.interpolation import Interpolation, between
from montecarlo_brdf.table.subject import Subject

Array = NDArray[np.float64]
LEVEL = 1e-9  # of a refutation's false alarm
AGAIN = 1 << 33  # beyond the seeds of people, and of others that confirm


class Truth(NamedTuple):
    """What is known: the cells, and fresh places."""

    subject: Subject
    terms: Terms
    cells: Cells
    fresh: Fresh
    threads: int = 1

    def of_function(self, stand: Stand) -> list[Deviation]:
        """Of a function of the axes: at cells, at fresh places, and up from the worst of them."""
        places = np.array(list(points(self.subject.axes)))
        rows = self.of_cells(stand(places))
        if len(self.fresh.points):
            rows = [max(pair, key=_size) for pair in zip(rows, self.of_fresh(stand), strict=True)]
        return climbed(self.subject, self.terms, stand, rows, self.threads)

    def of_cells(self, values: Array) -> list[Deviation]:
        """Of a table's cells."""
        places = np.array(list(points(self.subject.axes)))
        flat = Cells(*(x.reshape(len(x), -1) for x in self.cells))
        return deviations(self.subject.axes, places, values.reshape(len(values), -1), flat)

    def of_fresh(self, stand: Stand) -> list[Deviation]:
        """Between the cells."""
        fresh = self.fresh
        return deviations(self.subject.axes, fresh.points, stand(fresh.points), fresh.truth)

    def of_interpolation(self, kind: Interpolation) -> tuple[list[Deviation], list[Deviation]]:
        """Of the table itself: between its outermost cells, and in the whole ranges."""
        axes, fresh = self.subject.axes, self.fresh
        found = between(self.cells.values, axes, fresh.points, kind)
        ends = [(a.first, a.last) for a in axes]
        inside = np.all([(low <= x) & (x <= high) for (low, high), x
                         in zip(ends, fresh.points.T, strict=True)], axis=0)  # fmt: skip
        whole = deviations(axes, fresh.points, found, fresh.truth)
        if not inside.any():
            return [], whole
        part = Cells(fresh.truth.values[:, inside], fresh.truth.errors[:, inside])
        return deviations(axes, fresh.points[inside], found[:, inside], part), whole

    def again(self, measure: int, one: Deviation) -> Deviation:
        """A deviation at its place, by fresh randomisations and nearly sure."""
        terms = self.terms._replace(level=LEVEL, seed=self.terms.seed + AGAIN)
        place = tuple(one.where[axis.name] for axis in self.subject.axes)
        found = at(self.subject, terms, [place])
        value, error = float(found.values[measure, 0]), float(found.errors[measure, 0])
        before = _value(self, measure, one)
        return one._replace(worst=before - value, error=error)


def _value(truth: Truth, measure: int, one: Deviation) -> float:
    """What stood for the truth there."""
    place = tuple(one.where[axis.name] for axis in truth.subject.axes)
    found = at(truth.subject, truth.terms, [place])
    return one.worst + float(found.values[measure, 0])


def _size(one: Deviation) -> float:
    return abs(one.worst) if math.isfinite(one.worst) else math.inf
