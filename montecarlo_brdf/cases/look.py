"""A model at the points of a case: one look that all checks share."""

from __future__ import annotations

import functools
import threading
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases import dictionary, margins, parameters
from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.cases.directions import place
from montecarlo_brdf.cases.points import EVEN, FEWEST, Points, edges, even, joined
from montecarlo_brdf.compile.bind import Function
from montecarlo_brdf.estimate.places import draws_of, rows_of, values_of

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array


AGAIN = 4  # times that a point where the code turns is asked with other directions


class Look:
    """A model at the points of a case, with the values of f there."""

    def __init__(self, case: Case) -> None:
        self.case, self.model = case, case.model
        self.points = joined(list(_sources(case)))
        self.sets = rows_of(case.model, case.one, self.points.table)
        self.f = values_of(case.model, case.model.f, self.points.wo, self.points.wi, self.sets)

    @functools.cached_property
    def draws(self) -> tuple[Array, Array]:
        """A draw of the model's sampler at each point, and its weight."""
        return draws_of(self.model, self.points.wo, self.points.u, self.sets)

    def __len__(self) -> int:
        return len(self.f)

    def values(self, function: Function, wo: Array, wi: Array, index: Any = slice(None)) -> Array:
        """f or pdf at other directions, with the parameters of the points of an index."""
        return values_of(self.model, function, wo, wi, self.sets.at(index))

    def parameters(self, k: int) -> Parameters:
        """The parameter set of a point."""
        found: Parameters = self.sets.parameters(k)
        return found

    def where(self, k: int) -> dict[str, float]:
        """A point as findings give it."""
        changed = parameters.changed(self.case, self.parameters(k))
        return {**changed, **place(self.points.wo[k], self.points.wi[k])}

    def source(self, k: int) -> str:
        """What led to a point, if that is worth telling."""
        return self.points.labels[int(self.points.label[k])]


def _sources(case: Case) -> Iterator[Points]:
    yield even(case, case.budget(EVEN, FEWEST))
    yield edges(case)
    yield dictionary.points(case)
    if (turns := margins.points(case)) is not None:
        yield from around(case, turns)


def around(case: Case, turns: Points) -> Iterator[Points]:
    """Points where the code turns, as they are, with other wi and u, and with other directions."""
    yield turns
    many = turns.at(np.repeat(np.arange(len(turns.wo)), AGAIN))
    other = even(case, len(many.wo), "turns")
    yield many._replace(wi=other.wi, u=other.u)
    yield many._replace(wo=other.wo, wi=other.wi, u=other.u)


_lock = threading.Lock()  # checks that run side by side share what is found


@functools.lru_cache(maxsize=8)
def _look(case: Case) -> Look:
    return Look(case)


def look(case: Case) -> Look:
    """The model at the points of a case: once for all checks."""
    subject = Case(case.model, case.p, (), free=case.free, seed=case.seed, effort=case.effort)
    with _lock:
        return _look(subject)
