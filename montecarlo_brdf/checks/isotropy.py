"""Isotropy: does turning both directions about the normal change nothing?

Half of the azimuth may be dropped, and findings at one azimuth speak for all, only where this
holds. It cannot see: a dependence between the pairs looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from montecarlo_brdf.checks import directions, interiors
from montecarlo_brdf.checks.case import Case, pointwise
from montecarlo_brdf.checks.claim import Claim, Exact, ExactClaim, Reference, Skip

NAME = "isotropy"
QUESTION = "does turning both directions change nothing?"
PROPERTY = "isotropy"
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
        "at most",
        Reference(0.0, 0.0, "law", "declared isotropic"),
        case.tolerated(TOLERANCE),
        lambda: _worst(case),
        property=PROPERTY,
    )


def _worst(case: Case) -> Exact:
    found = Exact(0.0, points=0)
    for k, p in enumerate(interiors.sets(case, 2)):
        rng = case.random(NAME, k)
        kinds = [directions.random_pairs(rng), directions.lobe_pairs(case, p, rng)]
        wo, wi = (np.concatenate(side) for side in zip(*kinds, strict=True))
        phi = 2.0 * np.pi * rng.random(len(wo))
        f = pointwise(case.model, p)
        before, after = f.f(wo, wi), f.f(_turned(wo, phi), _turned(wi, phi))
        usable = np.isfinite(before) & np.isfinite(after)
        high = np.where(usable, np.maximum(np.abs(before), np.abs(after)), 0.0)
        floor = max(NEGLIGIBLE * float(high.max(initial=0.0)), 1e-300)
        change = np.where(usable, np.abs(before - after), 0.0) / np.maximum(high, floor)
        if change.max(initial=0.0) > TOLERANCE:
            apart = np.abs(before - after)
            change = directions.unexplained(change, apart, TOLERANCE, f.f, wo, wi, rng)
        j = int(np.argmax(change))
        points = found.points + len(wo)
        if change[j] >= found.value:
            where = {**interiors.changed(case, p), **directions.place(wo[j], wi[j])}
            hint = f"f depends on the azimuth itself (turned by {np.degrees(phi[j]):.0f} degrees)"
            found = Exact(float(change[j]), 0.0, where, points, hint=hint)
        found = found._replace(points=points)
    return found


def _turned(w: Any, phi: Any) -> Any:
    c, s = np.cos(phi), np.sin(phi)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=-1)
