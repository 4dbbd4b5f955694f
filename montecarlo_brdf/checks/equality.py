"""Equality: is it the model that it says it is (`same_as`, --against)?

Values of f are compared over edge, random and lobe pairs. It cannot see: a difference between the
pairs looked at, or beyond the parameters that the two models share.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.cases.look import Look, look
from montecarlo_brdf.cases.points import even
from montecarlo_brdf.checks._difference import worst
from montecarlo_brdf.checks._hints import dependence_named, moved_named, shape_named
from montecarlo_brdf.estimate.places import parameter_rows, values_of
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference, Skip
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model, Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "equality"
QUESTION = "is it the model that it says it is?"
PROPERTY = Property.REFERENCE
#: conventions in which parameters are confused
MAPPINGS = {
    "{}^2": lambda v: v * v,
    "sqrt({})": lambda v: math.sqrt(abs(v)),
    "{} in degrees": math.radians,
    "{} in radians": math.degrees,
}
TOLERANCE = 1e-6  # relative to the larger of the two values
ROUNDED = 1e-6  # of the median of f: values below are held against that
SOME = 20_000  # points that are looked at for a cause


class Cause(NamedTuple):
    """A likely cause in words; everywhere: it holds for all values alike, no other is sought."""

    text: str
    everywhere: bool = False


def claims(case: Case) -> Iterator[Claim]:
    """f equals the other model's f."""
    other = case.against or (load(case.model.same_as) if case.model.same_as else None)
    if other is None:
        yield Skip("equality", "nothing to compare with: declare same_as, or use --against")
        return
    yield ExactClaim(
        f"|f - f of {other.name}|/f",
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.DECLARED, f"same as {other.name}"),
        case.tolerated(TOLERANCE),
        lambda: difference(case, other),
        property=PROPERTY,
    )


def shared(other: Model, p: Parameters) -> Parameters:
    """The other model's parameter set: the names they share, its defaults otherwise."""
    names = set(other.Params._fields)  # type: ignore[attr-defined]
    found: Parameters = other.parameters(**{n: v for n, v in p._asdict().items() if n in names})
    return found


def difference(case: Case, other: Model, *name: object, q: Parameters | None = None) -> Exact:
    """The worst relative difference of two models' values, with the parameters that they share, or
    with the other's set q."""
    at, rng, n = look(case), case.random(NAME, *name), len(look(case))
    columns = {} if q else at.sets.columns(other.Params)
    same = parameter_rows(other, columns, q or shared(other, case.one), n)
    theirs = values_of(other, other.f, at.points.wo, at.points.wi, same)
    usual = float(np.nanmedian(np.abs(at.f)) / max(np.nanmax(np.abs(at.f)), 1e-300))
    there = at.points.wo, at.points.wi
    k, found = worst(at, theirs, there, ROUNDED * usual, TOLERANCE)
    hint = _told(at, k, other, same.parameters(k), rng) if found > TOLERANCE else None
    return Exact(found, 0.0, at.where(k), n, hint=hint)


def _told(at: Look, k: int, other: Model, q: Parameters, rng: np.random.Generator) -> str:
    """What the two models say of their difference, with the parameters of a point."""
    p = at.parameters(k)
    some = slice(None, None, max(1, len(at) // SOME))
    wo, wi = (np.concatenate([w[some], w[k : k + 1]]) for w in (at.points.wo, at.points.wi))
    ours, theirs = pointwise(at.model, p).f(wo, wi), pointwise(other, q).f(wo, wi)
    usable = np.isfinite(ours) & np.isfinite(theirs)
    ours, theirs = np.where(usable, ours, 0.0), np.where(usable, theirs, 0.0)
    cause = _remapped(ours, wo, wi, other, q) or _cause(ours, theirs, wo, wi, -1)
    moved = None if cause.everywhere else _moved(at.case, p, other, q, rng)
    return (f"{cause.text}; {moved}" if moved else cause.text) + at.source(k)


def _moved(
    case: Case, p: Parameters, other: Model, q: Parameters, rng: np.random.Generator
) -> str | None:
    """What turning or swapping directions says about the difference."""
    at = even(case._replace(p=p, free=()), 2400, NAME)
    wo, wi = at.wo, at.wi
    ordinary = (wo[:, 2] > 0.1) & (wi[:, 2] > 0.1)
    wo, wi = wo[ordinary], wi[ordinary]
    one, two = pointwise(case.model, p).f, pointwise(other, q).f
    with np.errstate(divide="ignore", invalid="ignore"):
        meant = moved_named(lambda a, b: one(wo, wi) / two(a, b), wo, wi)
        if meant:
            return f"it is {other.name} {meant}"
        return dependence_named(lambda a, b: one(a, b) / two(a, b), wo, wi)


def _remapped(ours: Array, wo: Array, wi: Array, other: Model, q: Parameters) -> Cause | None:
    """The other model with a parameter mapped as conventions differ, if that is what f is."""
    some = slice(None, None, 97)
    for name in q._fields:
        for words, mapping in MAPPINGS.items():
            changed = q._replace(**{name: mapping(getattr(q, name))})
            values = pointwise(other, changed).f(wo[some], wi[some])
            same = np.isclose(values, ours[some], rtol=1e-6, atol=0.0)
            lit = same[ours[some] > 0.0]
            if changed != q and lit.size and np.mean(lit) > 0.9:
                text = f"it is {other.name} with {words.format(name)} where {name} is meant"
                return Cause(text)
    return None


def _cause(ours: Array, theirs: Array, wo: Array, wi: Array, k: int) -> Cause:
    """A constant ratio, or one that is a cosine, names the mistake."""
    both = (ours > 0.0) & (theirs > 0.0)
    ratio = ours[both] / theirs[both]
    ordinary = (wo[both][:, 2] > 0.05) & (wi[both][:, 2] > 0.05)
    named = shape_named(ratio[ordinary], wo[both][ordinary], wi[both][ordinary])
    if named:
        return Cause(f"f / f expected = {named}", everywhere=True)
    steep = np.minimum(wo[both][:, 2], wi[both][:, 2])[np.abs(ratio - 1.0) > 10.0 * TOLERANCE]
    if len(steep) >= 20 and steep.max() < 0.5:
        beyond = math.degrees(math.acos(steep.max()))
        return Cause(f"f differs only beyond {beyond:.0f} degrees: look at clamps of cosines")
    clipped = 20 < np.count_nonzero(ours == ours.max()) < 0.9 * len(ours)  # or it is constant
    if clipped and theirs.max() > ours.max():
        text = f"f never exceeds {ours.max():.6g}: clipped, {theirs.max():.6g} is expected"
        return Cause(text)
    return Cause(f"f = {ours[k]:.6g} where {theirs[k]:.6g} is expected")
