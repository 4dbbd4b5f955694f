"""Isotropy: does turning both directions about the normal change nothing?

Half of the azimuth may be dropped, and findings at one azimuth speak for all, only where this
holds. It cannot see: a dependence between the pairs looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import directions, parameters
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference, Skip, worst_of
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "isotropy"
QUESTION = "does turning both directions change nothing?"
PROPERTY = Property.ISOTROPY
#: relative; turning moves a direction by an ulp or two, a lobe of width alpha by that over alpha
TOLERANCE = 1e-6
NEGLIGIBLE = 1e-25


def claims(case: Case) -> Iterator[Claim]:
    """One claim: no pair changes when it is turned."""
    if not case.model.isotropic:
        yield Skip("isotropy", f"model {case.model.name} says that it is anisotropic")
        return
    yield ExactClaim(
        "|f - f turned|/f",
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "declared isotropic"),
        case.tolerated(TOLERANCE),
        lambda: _worst(case),
        property=PROPERTY,
    )


def _worst(case: Case) -> Exact:
    sets = enumerate((*parameters.sets(case, 2), *parameters.extremes(case)))
    return worst_of(_worst_turned(case, p, case.random(NAME, k)) for k, p in sets)


def _worst_turned(case: Case, p: Parameters, rng: np.random.Generator) -> Exact:
    """The pair whose f changes most when it is turned by an azimuth of its own."""
    kinds = [
        directions.random_pairs(rng, case.budget(directions.RANDOM)),
        directions.lobe_pairs(case, p, rng, case.budget(directions.LOBE)),
    ]
    wo, wi = (np.concatenate(side) for side in zip(*kinds, strict=True))
    phi = 2.0 * np.pi * rng.random(len(wo))
    f = pointwise(case.model, p).f
    before, after = f(wo, wi), f(_turned(wo, phi), _turned(wi, phi))
    change = _relative(before, after)
    if change.max(initial=0.0) > TOLERANCE:
        with np.errstate(invalid="ignore"):
            apart = np.abs(before - after)
        change = directions.unexplained(change, apart, TOLERANCE, f, wo, wi, rng)
    k = int(np.argmax(change))
    where = {**parameters.changed(case, p), **directions.place(wo[k], wi[k])}
    hint = f"f depends on the azimuth itself (turned by {np.degrees(phi[k]):.0f} degrees)"
    return Exact(float(change[k]), 0.0, where, len(wo), hint=hint)


def _relative(before: Array, after: Array) -> Array:
    """|f - f turned|/f; 0 where one of them is not finite, which is positivity's business."""
    usable = np.isfinite(before) & np.isfinite(after)
    high = np.where(usable, np.maximum(np.abs(before), np.abs(after)), 0.0)
    floor = max(NEGLIGIBLE * float(high.max(initial=0.0)), 1e-300)
    return np.where(usable, np.abs(before - after), 0.0) / np.maximum(high, floor)


def _turned(w: Array, phi: Array) -> Array:
    c, s = np.cos(phi), np.sin(phi)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=-1)
