"""Equality: is it the model that it says it is (`same_as`, --against)?

Values of f are compared over edge, random and lobe pairs. It cannot see: a difference between the
pairs looked at, or beyond the parameters that the two models share.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from montecarlo_brdf.cases import directions, parameters
from montecarlo_brdf.cases.case import Case, Parameters, pointwise
from montecarlo_brdf.checks._hints import dependence_named, moved_named, shape_named
from montecarlo_brdf.estimate.places import Rows, pair_values, parameter_rows
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference, Skip, worst_of
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Model, Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Pairs

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
TOLERANCE = 1e-6  # relative to the larger of the two values, and to 1e-6 of the largest


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
        lambda: worst(case, other),
        property=PROPERTY,
    )


def worst(case: Case, other: Model) -> Exact:
    """The worst difference over the directions, and over the ranges of free parameters."""

    def apart(wo: Array, wi: Array, sets: Rows) -> Array:
        same = parameter_rows(other, sets.columns(other.Params), shared(other, case.one), len(wo))
        ours = pair_values(case.model, wo, wi, sets)
        return _relative(ours, pair_values(other, wo, wi, same))

    few = other.prepare is not None
    found = directions.subjects(case, case.random(NAME, "all"), apart, few)
    return worst_of(
        difference(case, p, other, shared(other, p), case.random(NAME, k), *more)
        for k, (p, *more) in enumerate(found)
    )


def shared(other: Model, p: Parameters) -> Parameters:
    """The other model's parameter set: the names they share, its defaults otherwise."""
    names = set(other.Params._fields)  # type: ignore[attr-defined]
    found: Parameters = other.parameters(**{n: v for n, v in p._asdict().items() if n in names})
    return found


def difference(
    case: Case, p: Parameters, other: Model, q: Parameters, rng: np.random.Generator, *more: Pairs
) -> Exact:
    """The worst relative difference of two models' values; `more` pairs than usual."""
    wo, wi = directions.all_pairs(case, p, rng, *more)
    ours, theirs = pointwise(case.model, p).f(wo, wi), pointwise(other, q).f(wo, wi)
    usable = np.isfinite(ours) & np.isfinite(theirs)
    ours, theirs = np.where(usable, ours, 0.0), np.where(usable, theirs, 0.0)
    relative = _relative(ours, theirs)
    if relative.max(initial=0.0) > TOLERANCE:
        f, apart = pointwise(case.model, p).f, np.abs(ours - theirs)
        relative = directions.unexplained(relative, apart, TOLERANCE, f, wo, wi, rng)
    k = int(np.argmax(relative))
    where = {**parameters.changed(case, p), **directions.place(wo[k], wi[k])}
    hint = None
    if relative[k] > TOLERANCE:
        cause = _remapped(ours, wo, wi, other, q) or _cause(ours, theirs, wo, wi, k)
        moved = None if cause.everywhere else _moved(case, p, other, q, rng)
        hint = f"{cause.text}; {moved}" if moved else cause.text
    return Exact(float(relative[k]), 0.0, where, len(wo), hint=hint)


def _relative(ours: Array, theirs: Array) -> Array:
    """|f - f'|/f; 0 where one of them is not finite, which is positivity's business."""
    difference = np.where(np.isfinite(ours) & np.isfinite(theirs), np.abs(ours - theirs), 0.0)
    high = np.maximum(np.abs(ours), np.abs(theirs))
    floor = max(1e-6 * float(np.nanmedian(high)), 1e-300)
    return difference / np.fmax(high, floor)


def _moved(
    case: Case, p: Parameters, other: Model, q: Parameters, rng: np.random.Generator
) -> str | None:
    """What turning or swapping directions says about the difference."""
    kinds = directions.random_pairs(rng, 400), directions.lobe_pairs(case, p, rng, 2000)
    wo, wi = (np.concatenate(side) for side in zip(*kinds, strict=True))
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
