"""Reciprocity: f(wo, wi) = f(wi, wo)? (Helmholtz; without it bidirectional methods are wrong.)

The worst relative difference over edge pairs, random pairs and pairs along the lobe, for the
parameters asked about, some of the interior, and those of the worst of many pairs with parameters
of their own. It cannot see: a violation between the pairs looked at, or below what moving the
directions by two ulps does.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from montecarlo_brdf.cases import directions, parameters
from montecarlo_brdf.cases.case import Case, pointwise
from montecarlo_brdf.estimate import scattered
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Reference, worst_of

NAME = "reciprocity"
QUESTION = "f(wo, wi) = f(wi, wo)?"
PROPERTY = "reciprocity"
#: relative; rounding of directions moves a lobe of width alpha by eps/alpha, far below this
TOLERANCE = 1e-6
#: values below this share of the largest are rounding
NEGLIGIBLE = 1e-25


def claims(case: Case) -> Iterator[Claim]:
    """One claim: no pair violates it."""
    yield ExactClaim(
        "|f - f'|/max(f, f')",
        {},
        "at most",
        Reference(0.0, 0.0, "law", "Helmholtz reciprocity"),
        case.tolerated(TOLERANCE),
        lambda: worst(case),
        property=PROPERTY,
    )


def worst(case: Case) -> Exact:
    """The worst pair over all parameter sets."""
    looks = [_worst_of(case, p, case.random(NAME, k)) for k, p in enumerate(parameters.sets(case))]

    def asymmetry(wo: Any, wi: Any, sets: scattered.Rows) -> Any:
        there = scattered.pair_values(case.model, wo, wi, sets)
        return _relative(there, scattered.pair_values(case.model, wi, wo, sets))

    if case.free:
        p, pair = directions.worst_pair(case, case.random(NAME, "everywhere"), asymmetry)
        one = _worst_of(case, p, case.random(NAME, "there"), pair)
        looks.append(one._replace(points=one.points + case.budget(directions.SCATTERED)))
    return worst_of(reversed(looks))  # of equal ones the first


def _relative(there: Any, back: Any) -> Any:
    """|f - f'|/max(f, f'); 0 where one of them is not finite, which is positivity's business."""
    usable = np.isfinite(there) & np.isfinite(back)
    there, back = np.where(usable, there, 0.0), np.where(usable, back, 0.0)
    high = np.maximum(np.abs(there), np.abs(back))
    floor = NEGLIGIBLE * float(high.max(initial=0.0))
    return np.abs(there - back) / np.maximum(high, floor if floor > 0.0 else 1.0)


def _worst_of(case: Case, p: Any, rng: Any, *more: Any) -> Exact:
    wo, wi = directions.all_pairs(case, p, rng, *more)
    f = pointwise(case.model, p).f
    there, back = f(wo, wi), f(wi, wo)
    relative = _relative(there, back)
    k = int(np.argmax(relative))
    if relative[k] > TOLERANCE:
        relative = directions.unexplained(relative, np.abs(there - back), TOLERANCE, f, wo, wi, rng)
    k = int(np.argmax(relative))
    where = {**parameters.changed(case, p), **directions.place(wo[k], wi[k])}
    hint = _hint(there[k], back[k], wo[k], wi[k])
    if relative[k] > TOLERANCE and "cosine" not in hint and _one_sided(case, p, rng):
        hint += ": f is symmetric but for a factor that depends on one direction alone"
    return Exact(float(relative[k]), 0.0, where, len(wo), hint=hint)


def _one_sided(case: Case, p: Any, rng: Any) -> bool:
    """Whether f(a, b)/f(b, a) = g(a)/g(b): then the ratios of three directions multiply to 1."""
    f = pointwise(case.model, p).f
    (a, b), (c, _) = directions.random_pairs(rng, 400), directions.random_pairs(rng, 400)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        round_trip = f(a, b) * f(b, c) * f(c, a) / (f(b, a) * f(c, b) * f(a, c))
    usable = round_trip[np.isfinite(round_trip)]
    return len(usable) > 200 and float(np.quantile(np.abs(usable - 1.0), 0.95)) < TOLERANCE


def _hint(there: float, back: float, wo: Any, wi: Any) -> str:
    """What the ratio of the two values says."""
    said = f"f = {there:.6g} one way and {back:.6g} the other"
    if there > 0.0 and back > 0.0:
        for name, ratio in (("cos_o/cos_i", wo[2] / wi[2]), ("cos_i/cos_o", wi[2] / wo[2])):
            if abs(ratio - 1.0) > 1e-3 and abs(there / back / ratio - 1.0) < 1e-3:
                return f"{said}: their ratio is {name}, a cosine belongs to one direction only"
    return said
