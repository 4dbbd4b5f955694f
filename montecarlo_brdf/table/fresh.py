"""How far something that stands for a table is from the truth: measured at fresh places.

Places are random and independent of the table, so that the largest of n deviations says of how much
of the domain more may be feared: a part larger than 1 - level^(1/n) would have shown one that is
larger, but for a chance of `level`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.table.axes import GRAZING, Angle, Axis, Point, said
from montecarlo_brdf.table.cell import Terms
from montecarlo_brdf.table.cells import Cells, at
from montecarlo_brdf.table.subject import Subject

Array = NDArray[np.float64]
#: values (measures, n) at places (n, axes)
Stand = Callable[[Array], Array]

DRAWS = 8  # times as many places are drawn at most where some are outside the model's domain
ROUNDS = 6  # of a climb from the worst place, each half as wide as the one before


class Deviation(NamedTuple):
    """The worst deviation of one measure, the certificate of the truth there, and the whole."""

    worst: float  # of signed ones
    error: float  # of the truth
    where: dict[str, float]
    rms: float
    places: int

    @property
    def most(self) -> float:
        """What it may be at most there."""
        return abs(self.worst) + self.error

    @property
    def least(self) -> float:
        """What it is at least there."""
        return max(0.0, abs(self.worst) - self.error)


class Fresh(NamedTuple):
    """Places, and what is true there."""

    points: Array  # (n, axes)
    truth: Cells
    left_out: int  # places outside the model's domain

    def unseen(self, level: float) -> float:
        """The part of the domain that may deviate by more than the worst here."""
        return 1.0 - math.exp(math.log(level) / max(1, len(self.points)))


def fresh(
    subject: Subject, terms: Terms, many: int, threads: int = 1, what: str = "fresh"
) -> Fresh:
    """The truth at random places of the axes' whole ranges."""
    rng = np.random.default_rng(stream(terms.seed, subject.model.identity, what))
    found: list[Point] = []
    drawn = 0
    while len(found) < many and drawn < DRAWS * many:
        point = tuple(_drawn(axis, rng.random()) for axis in subject.axes)
        drawn += 1
        try:
            subject.place(point)
        except UserError:
            continue
        found.append(point)
    truth = at(subject, terms, found, threads)
    return Fresh(np.array(found).reshape(-1, len(subject.axes)), truth, drawn - len(found))


def _drawn(axis: Axis, u: float) -> float:
    x = axis.low + u * (axis.high - axis.low)
    return max(x, GRAZING) if axis.name == Angle.MU else x


def deviations(
    axes: Sequence[Axis], points: Array, found: Array, truth: Cells
) -> list[Deviation]:
    """Of values (measures, n) from the truth, per measure."""
    rows = []
    for values, exact, errors in zip(found, truth.values, truth.errors, strict=True):
        away = values - exact
        sure = np.where(np.isfinite(away) & np.isfinite(errors), np.abs(away), np.inf)
        k = int(np.argmax(sure))
        rms = math.sqrt(float(np.mean(away * away)))
        rows.append(Deviation(float(away[k]), float(errors[k]), said(axes, points[k]), rms,
                              len(points)))  # fmt: skip
    return rows


def climbed(
    subject: Subject, terms: Terms, stand: Stand, begun: Sequence[Deviation], threads: int = 1
) -> list[Deviation]:
    """The worst place of each measure again, with what lies around it, ever nearer."""
    return [
        _climbed(subject, terms, stand, k, one, threads) if math.isfinite(one.worst) else one
        for k, one in enumerate(begun)
    ]


def _climbed(
    subject: Subject, terms: Terms, stand: Stand, k: int, best: Deviation, threads: int
) -> Deviation:
    reach = np.array([0.5 * axis.step for axis in subject.axes])
    steps = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * len(reach), indexing="ij"), axis=-1)
    for _ in range(ROUNDS):
        centre = np.array([best.where[axis.name] for axis in subject.axes])
        around = _inside(subject, centre + steps.reshape(-1, len(reach)) * reach)
        if not around:
            break
        places, truth = np.array(around), at(subject, terms, around, threads)
        one = Cells(truth.values[k : k + 1], truth.errors[k : k + 1])
        found = deviations(subject.axes, places, stand(places)[k : k + 1], one)[0]
        if found.least > abs(best.worst):
            best = best._replace(worst=found.worst, error=found.error, where=found.where)
        reach *= 0.5
    return best


def _inside(subject: Subject, places: Array) -> list[Point]:
    """Those within the ranges of the axes where the model is defined."""
    found = []
    for place in places:
        inside = all(a.low <= x <= a.high for a, x in zip(subject.axes, place, strict=True))
        point = tuple(map(float, place))
        try:
            if inside and not any(
                a.name == Angle.MU and x <= 0.0 for a, x in zip(subject.axes, point, strict=True)
            ):
                subject.place(point)
                found.append(point)
        except UserError:
            continue
    return found
