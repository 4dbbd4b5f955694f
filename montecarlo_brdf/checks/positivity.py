"""Positivity: is f finite and at least 0 everywhere?

Over edge pairs (theta up to 90 degrees less an ulp, wi = wo, wi = mirror, wi . wo = 0), random
pairs, pairs along the lobe; for the parameters asked about, some of the interior, and each at the
ends of its range. A value below zero counts if it is more than rounding where it was computed:
1e-12 of the largest |f| between the same polar angles, at any azimuth, or of the median of |f|.
(Not of the largest |f| at all: where that is unbounded it would hide any value.)
It cannot see: a wrong value that is finite and positive.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import directions, parameters
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.estimate.places import Rows, pair_values
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Deviation

NAME = "positivity"
QUESTION = "finite and >= 0 everywhere?"
PROPERTY = Property.POSITIVITY


def claims(case: Case) -> Iterator[Claim]:
    """No value that is not finite, and no negative one."""
    seen = functools.cache(lambda: _seen(case))
    yield ExactClaim(
        "values of f not finite",
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "a BRDF is a density of reflected light"),
        0.0,
        lambda: seen()[0],
        property=PROPERTY,
    )
    yield ExactClaim(
        "smallest f / f around it",
        {},
        Bound.AT_LEAST,
        Reference(0.0, 0.0, Kind.LAW, "a BRDF is a density of reflected light"),
        case.tolerated(directions.ROUNDING),
        lambda: seen()[1],
        property=PROPERTY,
    )


def _lowest(case: Case) -> Deviation:
    """How low f is at many pairs, each with parameters of its own; what is no number first."""

    def lowest(wo: Array, wi: Array, sets: Rows) -> Array:
        f = pair_values(case.model, wo, wi, sets)
        return np.where(np.isfinite(f), -f, np.inf)

    return lowest


def _values(case: Case) -> Iterator[tuple[Parameters, Array, Array, Array]]:
    found = directions.subjects(case, case.random(NAME, "all"), _lowest(case))
    for k, (p, *more) in enumerate(found):
        wo, wi = directions.all_pairs(case, p, case.random(NAME, k), *more)
        yield p, wo, wi, pointwise(case.model, p).f(wo, wi)


def _seen(case: Case) -> tuple[Exact, Exact]:
    """How many values are not finite, and the smallest one in relation to those around it."""
    wild, low = Exact(0.0, points=0), Exact(0.0, points=0)
    for p, wo, wi, f in _values(case):
        wild = _not_finite(case, p, wo, wi, f, wild)
        low = _smallest(case, p, wo, wi, f, low)
    return wild, low


def _not_finite(case: Case, p: Parameters, wo: Array, wi: Array, f: Array, found: Exact) -> Exact:
    """`found` with the values that are not finite counted, and the place of the first."""
    bad, points = ~np.isfinite(f), found.points + len(f)
    if bad.any() and not found.value:
        k = int(np.argmax(bad))
        where = {**parameters.changed(case, p), **directions.place(wo[k], wi[k])}
        hint = f"f is {f[k]} at {_name(wo[k], wi[k])}: look for 0/0, 1/0 or the root of a negative"
        return Exact(float(bad.sum()), 0.0, where, points, hint=hint)
    return found._replace(value=found.value + float(bad.sum()), points=points)


def _smallest(case: Case, p: Parameters, wo: Array, wi: Array, f: Array, found: Exact) -> Exact:
    """`found`, or a value that lies deeper below zero."""
    (low,) = np.nonzero(np.isfinite(f) & (f < 0.0))
    points = found.points + len(f)
    if not len(low):
        return found._replace(points=points)
    value = f[low] / _scale(case, p, wo[low], wi[low])
    if value.min() >= found.value:
        return found._replace(points=points)
    k = low[int(np.argmin(value))]
    where = {**parameters.changed(case, p), **directions.place(wo[k], wi[k])}
    hint = f"f = {f[k]:.6g} at {_name(wo[k], wi[k])}"
    return Exact(float(value.min()), 0.0, where, points, hint=hint)


def _scale(case: Case, p: Parameters, wo: Array, wi: Array) -> Array:
    """The largest |f| between the polar angles of each pair, and at least the median of |f|."""
    pairs = directions.random_pairs(case.random(NAME, "median"), case.budget(directions.RANDOM))
    f = np.abs(pointwise(case.model, p).f(*pairs))
    f = f[np.isfinite(f) & (f > 0.0)]
    scale = np.full(len(wo), np.median(f) if len(f) else 1.0)
    highest: Array = np.fmax(scale, directions.around(pointwise(case.model, p).f, wo, wi))
    return highest


def _name(wo: Array, wi: Array) -> str:
    """The kind of place, in words where it has a name."""
    named = []
    if min(wo[2], wi[2]) < 1e-4:
        named.append("a grazing direction")
    if max(wo[2], wi[2]) > 1.0 - 1e-12:
        named.append("normal incidence")
    if np.abs(wo - wi).max() < 1e-12:
        named.append("wi = wo")
    if np.abs(wo * np.array([-1.0, -1.0, 1.0]) - wi).max() < 1e-12:
        named.append("the mirror direction")
    return " and ".join(named) or "an ordinary pair of directions"
