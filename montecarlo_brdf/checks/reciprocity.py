"""Reciprocity: f(wo, wi) = f(wi, wo)? (Helmholtz; without it bidirectional methods are wrong.)

The worst relative difference over the points that all laws are asked at (cases.points).
It cannot see: a violation between these, or below what moving the directions by some ulps does.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import directions
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.cases.look import Look, look
from montecarlo_brdf.checks._difference import worst
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "reciprocity"
QUESTION = "f(wo, wi) = f(wi, wo)?"
PROPERTY = Property.RECIPROCITY
#: relative; rounding of directions moves a lobe of width alpha by eps/alpha, far below this
TOLERANCE = 1e-6


def claims(case: Case) -> Iterator[Claim]:
    """One claim: no pair violates it."""
    yield ExactClaim(
        "|f - f'|/max(f, f')",
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "Helmholtz reciprocity"),
        case.tolerated(TOLERANCE),
        lambda: _worst(look(case)),
        property=PROPERTY,
    )


def _worst(at: Look) -> Exact:
    back = at.values(at.model.f, at.points.wi, at.points.wo)
    k, deviation = worst(at, back, (at.points.wi, at.points.wo), tolerance=TOLERANCE)
    hint = f"f = {at.f[k]:.6g} one way and {back[k]:.6g} the other"
    if named := _cosine_named(at.f[k], back[k], at.points.wo[k], at.points.wi[k]):
        hint += f": their ratio is {named}, a cosine belongs to one direction only"
    elif deviation > TOLERANCE and _one_sided(at.case, at.parameters(k), at.case.random(NAME)):
        hint += ": f is symmetric but for a factor that depends on one direction alone"
    return Exact(deviation, 0.0, at.where(k), len(at), hint=hint + at.source(k))


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
