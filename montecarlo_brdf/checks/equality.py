"""Equality: is it the model that it says it is (`same_as`, --against)?

Values of f are compared over edge, random and lobe pairs. It cannot see: a difference between the
pairs looked at, or beyond the parameters that the two models share.
"""
from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from montecarlo_brdf.checks import directions, interiors
from montecarlo_brdf.checks.case import Case, pointwise
from montecarlo_brdf.checks.claim import Claim, Exact, ExactClaim, Reference, Skip
from montecarlo_brdf.checks.hints import factor_named
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model

NAME = "equality"
QUESTION = "is it the model that it says it is?"
PROPERTY = "reference"
TOLERANCE = 1e-6  # relative to the larger of the two values, and to 1e-6 of the largest


def claims(case: Case) -> Iterator[Claim]:
    """f equals the other model's f."""
    other = case.against or (load(case.model.same_as) if case.model.same_as else None)
    if other is None:
        yield Skip("equality", "nothing to compare with: declare same_as, or use --against")
        return
    yield ExactClaim(
        f"|f - f of {other.name}|/f",
        {},
        "at most",
        Reference(0.0, 0.0, "declared", f"same as {other.name}"),
        case.tolerated(TOLERANCE),
        lambda: _worst(case, other),
        property=PROPERTY,
    )


def _worst(case: Case, other: Model) -> Exact:
    found = Exact(0.0, points=0)
    for k, p in enumerate(interiors.sets(case)):
        one = difference(case, p, other, shared(other, p), case.random(NAME, k))
        points = found.points + one.points
        found = (one if one.value >= found.value else found)._replace(points=points)
    return found


def shared(other: Model, p: Any) -> Any:
    """The other model's parameter set: the names they share, its defaults otherwise."""
    names = set(other.Params._fields)  # type: ignore[attr-defined]
    return other.parameters(**{n: v for n, v in p._asdict().items() if n in names})


def difference(case: Case, p: Any, other: Model, q: Any, rng: Any) -> Exact:
    """The worst relative difference of two models' values."""
    wo, wi = directions.all_pairs(case, p, rng)
    ours, theirs = pointwise(case.model, p).f(wo, wi), pointwise(other, q).f(wo, wi)
    usable = np.isfinite(ours) & np.isfinite(theirs)
    ours, theirs = np.where(usable, ours, 0.0), np.where(usable, theirs, 0.0)
    high = np.maximum(np.abs(ours), np.abs(theirs))
    floor = max(1e-6 * float(np.median(high)), 1e-300)
    relative = np.abs(ours - theirs) / np.maximum(high, floor)
    k = int(np.argmax(relative))
    where = {**interiors.changed(case, p), **directions.place(wo[k], wi[k])}
    return Exact(float(relative[k]), 0.0, where, len(wo), hint=_hint(ours, theirs, wo, wi, k))


def _hint(ours: Any, theirs: Any, wo: Any, wi: Any, k: int) -> str:
    """A constant ratio, or one that is a cosine, names the mistake."""
    both = (ours > 0.0) & (theirs > 0.0)
    ratio = ours[both] / theirs[both]
    ordinary = (wo[both][:, 2] > 0.05) & (wi[both][:, 2] > 0.05)
    ratio, mu_i, mu_o = ratio[ordinary], wi[both][ordinary][:, 2], wo[both][ordinary][:, 2]
    shapes = {
        "": np.ones_like(ratio),
        " cos_i": mu_i,
        " cos_o": mu_o,
        "/cos_i": 1.0 / mu_i,
        "/cos_o": 1.0 / mu_o,
        " cos_i cos_o": mu_i * mu_o,
    }
    for name, shape in shapes.items():
        quotient = ratio / shape
        if len(quotient) > 100 and np.ptp(quotient) < 2e-3 * abs(np.median(quotient)):
            factor = float(np.median(quotient))
            return f"f / f expected = {factor:.6g}{name} everywhere: {_cause(factor, name)}"
    return f"f = {ours[k]:.6g} where {theirs[k]:.6g} is expected"


def _cause(factor: float, shape: str) -> str:
    if shape:
        return "a cosine is included that does not belong to f" if "/" not in shape else "divided by a cosine"
    return factor_named(factor) or "a constant factor"
