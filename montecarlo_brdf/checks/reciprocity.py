"""Reciprocity: f(wo, wi) = f(wi, wo)? (Helmholtz; without it bidirectional methods are wrong.)

The worst relative difference over edge pairs, random pairs and pairs along the lobe, for the
parameters asked about, some of the interior, and those of the worst of many pairs with parameters
of their own. It cannot see: a violation between the pairs looked at, or below what moving the
directions by two ulps does.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import directions, parameters
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.estimate.places import Rows, pair_values
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference, worst_of
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Pairs

NAME = "reciprocity"
QUESTION = "f(wo, wi) = f(wi, wo)?"
PROPERTY = Property.RECIPROCITY
#: relative; rounding of directions moves a lobe of width alpha by eps/alpha, far below this
TOLERANCE = 1e-6
#: values below this share of the largest are rounding
NEGLIGIBLE = 1e-25


def claims(case: Case) -> Iterator[Claim]:
    """One claim: no pair violates it."""
    yield ExactClaim(
        "|f - f'|/max(f, f')",
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "Helmholtz reciprocity"),
        case.tolerated(TOLERANCE),
        lambda: worst(case),
        property=PROPERTY,
    )


def worst(case: Case) -> Exact:
    """The worst pair over all parameter sets."""
    found = [_worst_of(case, p, case.random(NAME, k)) for k, p in enumerate(parameters.sets(case))]

    def asymmetry(wo: Array, wi: Array, sets: Rows) -> Array:
        there = pair_values(case.model, wo, wi, sets)
        return _relative(there, pair_values(case.model, wi, wo, sets))

    if case.free:
        p, pair = directions.worst_pair(case, case.random(NAME, "everywhere"), asymmetry)
        one = _worst_of(case, p, case.random(NAME, "there"), pair)
        found.append(one._replace(points=one.points + case.budget(directions.SCATTERED)))
    return worst_of(reversed(found))  # of equal ones the first


def _relative(there: Array, back: Array) -> Array:
    """|f - f'|/max(f, f'); 0 where one of them is not finite, which is positivity's business."""
    usable = np.isfinite(there) & np.isfinite(back)
    there, back = np.where(usable, there, 0.0), np.where(usable, back, 0.0)
    high = np.maximum(np.abs(there), np.abs(back))
    floor = NEGLIGIBLE * float(high.max(initial=0.0))
    return np.abs(there - back) / np.maximum(high, floor if floor > 0.0 else 1.0)


def _worst_of(case: Case, p: Parameters, rng: np.random.Generator, *more: Pairs) -> Exact:
    wo, wi = directions.all_pairs(case, p, rng, *more)
    f = pointwise(case.model, p).f
    there, back = f(wo, wi), f(wi, wo)
    relative = _relative(there, back)
    k = int(np.argmax(relative))
    if relative[k] > TOLERANCE:
        with np.errstate(invalid="ignore"):
            apart = np.abs(there - back)
        relative = directions.unexplained(relative, apart, TOLERANCE, f, wo, wi, rng)
    k = int(np.argmax(relative))
    where = {**parameters.changed(case, p), **directions.place(wo[k], wi[k])}
    hint = f"f = {there[k]:.6g} one way and {back[k]:.6g} the other"
    if named := _cosine_named(there[k], back[k], wo[k], wi[k]):
        hint += f": their ratio is {named}, a cosine belongs to one direction only"
    elif relative[k] > TOLERANCE and _one_sided(case, p, rng):
        hint += ": f is symmetric but for a factor that depends on one direction alone"
    return Exact(float(relative[k]), 0.0, where, len(wo), hint=hint)


def _one_sided(case: Case, p: Parameters, rng: np.random.Generator) -> bool:
    """Whether f(a, b)/f(b, a) = g(a)/g(b): then the ratios of three directions multiply to 1."""
    f = pointwise(case.model, p).f
    (a, b), (c, _) = directions.random_pairs(rng, 400), directions.random_pairs(rng, 400)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        round_trip = f(a, b) * f(b, c) * f(c, a) / (f(b, a) * f(c, b) * f(a, c))
    usable = round_trip[np.isfinite(round_trip)]
    return len(usable) > 200 and float(np.quantile(np.abs(usable - 1.0), 0.95)) < TOLERANCE


def _cosine_named(there: float, back: float, wo: Array, wi: Array) -> str | None:
    """The ratio of two cosines that the ratio of the two values is, if it is one."""
    if not (there > 0.0 and back > 0.0):
        return None
    ratios = {"cos_o/cos_i": wo[2] / wi[2], "cos_i/cos_o": wi[2] / wo[2]}
    telling = {k: r for k, r in ratios.items() if abs(r - 1.0) > 1e-3}
    return next((k for k, r in telling.items() if abs(there / back / r - 1.0) < 1e-3), None)
