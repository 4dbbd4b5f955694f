"""Isotropy: does turning both directions about the normal change nothing?

Half of the azimuth may be dropped, and findings at one azimuth speak for all, only where this
holds. It cannot see: a dependence between the pairs looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.look import Look, look
from montecarlo_brdf.checks._difference import worst
from montecarlo_brdf.judge.claim import Claim, Exact, ExactClaim, Kind, Reference, Skip
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "isotropy"
QUESTION = "does turning both directions change nothing?"
PROPERTY = Property.ISOTROPY
#: relative; turning moves a direction by an ulp or two, a lobe of width alpha by that over alpha
TOLERANCE = 1e-6


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
        lambda: _worst(look(case)),
        property=PROPERTY,
    )


def _worst(at: Look) -> Exact:
    """The point whose f changes most when it is turned by an azimuth of its own."""
    phi = 2.0 * np.pi * at.case.random(NAME).random(len(at))
    pair = _turned(at.points.wo, phi), _turned(at.points.wi, phi)
    k, change = worst(at, at.values(at.model.f, *pair), pair, tolerance=TOLERANCE)
    hint = f"f depends on the azimuth itself (turned by {np.degrees(phi[k]):.0f} degrees)"
    return Exact(change, 0.0, at.where(k), len(at), hint=hint + at.source(k))


def _turned(w: Array, phi: Array) -> Array:
    c, s = np.cos(phi), np.sin(phi)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=-1)
