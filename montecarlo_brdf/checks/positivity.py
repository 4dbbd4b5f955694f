"""Positivity: is f finite and at least 0 everywhere?

At the points that all laws are asked at (cases.points): edge pairs (theta up to 90 degrees less an
ulp, wi = wo, wi = mirror, wi . wo = 0), everywhere, along the lobe, where the code branches. What
lies below zero counts if it is more than rounding where it was computed: 1e-12 of the largest |f|
between the same polar angles, at any azimuth, and of the median of |f| with its parameters. (Not of
the largest |f| at all: where that is unbounded it would hide any value.) A disclaimer of positivity
is about negative values: what is no number is never excused.
It cannot see: a wrong value that is finite and positive.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import directions
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.look import Look, look
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Index

NAME = "positivity"
QUESTION = "finite and >= 0 everywhere?"
PROPERTY = Property.POSITIVITY
LOWEST = 256  # values below zero, the lowest, that are held against those around them
USUAL = 64  # pairs whose median says how large f is with some parameters


def claims(case: Case) -> Iterator[Claim]:
    """No value that is not finite, and no negative one."""
    yield ExactClaim(
        "values of f not finite",
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "a BRDF is a density of reflected light"),
        0.0,
        lambda: _not_finite(look(case)),
        property=None,
    )
    yield ExactClaim(
        "smallest f / f around it",
        {},
        Bound.AT_LEAST,
        Reference(0.0, 0.0, Kind.LAW, "a BRDF is a density of reflected light"),
        case.tolerated(directions.ROUNDING),
        lambda: _smallest(look(case)),
        property=PROPERTY,
    )


def _not_finite(at: Look) -> Exact:
    """How many values are not finite, and the place of the first."""
    (bad,) = np.nonzero(~np.isfinite(at.f))
    if not len(bad):
        return Exact(0.0, points=len(at))
    k = int(bad[0])
    hint = f"f is {at.f[k]} at {_name(at.points.wo[k], at.points.wi[k])}: look for 0/0, 1/0 or "
    hint = f"{hint}the root of a negative{at.source(k)}"
    return Exact(float(len(bad)), 0.0, at.where(k), len(at), hint=hint)


def _smallest(at: Look) -> Exact:
    """The value that lies deepest below zero, in relation to those around it."""
    (low,) = np.nonzero(np.isfinite(at.f) & (at.f < 0.0))
    if not len(low):
        return Exact(0.0, points=len(at))
    low = low[np.argsort(at.f[low], kind="stable")][:LOWEST]
    value = at.f[low] / _scale(at, low)
    j = int(np.argmin(value))
    k = int(low[j])
    hint = f"f = {at.f[k]:.6g} at {_name(at.points.wo[k], at.points.wi[k])}{at.source(k)}"
    return Exact(float(value[j]), 0.0, at.where(k), len(at), hint=hint)


def _scale(at: Look, low: Index) -> Array:
    """The largest |f| between the polar angles of each point, and at least the median of |f|."""
    rng = at.case.random(NAME, "median")
    wo, wi = directions.random_pairs(rng, USUAL)
    many, each = np.repeat(low, USUAL), (len(low), 1)
    f = np.abs(at.values(at.model.f, np.tile(wo, each), np.tile(wi, each), many))
    f = np.where(np.isfinite(f) & (f > 0.0), f, np.nan).reshape(len(low), USUAL)
    dark = np.asarray(np.isnan(f).all(axis=1))
    median = np.where(dark, 1.0, np.nanmedian(np.where(dark[:, None], 1.0, f), axis=1))
    there = at.points.wo[low], at.points.wi[low]
    found = directions.around(lambda a, b: at.values(at.model.f, a, b, low), *there)
    highest: Array = np.fmax(median, found)
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
