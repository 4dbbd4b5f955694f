"""A where it is farthest from what a model's file says of it, of all angles and free parameters."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import parameters, worst
from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.cases.survey import reflected_of, survey
from montecarlo_brdf.checks import _albedo, _mixture, _truth
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Claim, Kind, MeanClaim, Reference
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

#: A by cosine of the polar angle and parameters
Known = Callable[[float, Parameters], float]
LOOK = 1 << 14  # nodes by which two places are compared
SMALLEST = 0.05  # albedo below which agreement is absolute


def farthest(
    case: Case, quantity: str, known: Known, source: str
) -> Claim:
    """A equals `known(cos_theta_o, p)` where it is farthest from it."""
    there, theta = _farthest(case, known)
    due = known(there.wo(theta)[2], there.one)
    measured = functools.cache(functools.partial(_albedo.measure, there, theta))
    turned = {} if case.model.isotropic else {"phi_o_deg": round(there.phi_o_deg, 3)}
    return MeanClaim(
        quantity,
        {"theta_o_deg": round(theta, 3), **turned, **parameters.changed(case, there.one)},
        Bound.EQUAL,
        Reference(due, 0.0, Kind.DECLARED, source),
        case.tolerated(AGREEMENT_TOLERANCE) * max(abs(due), SMALLEST),
        functools.partial(_albedo.of_channel, measured, 0),
        property=Property.REFERENCE,
        unit=_albedo.units(case.model, there.one),
        cause=functools.partial(_cause, case, there.one, theta, due),
        fallback=functools.partial(_truth.deterministic, case.model, there.one, there.wo(theta)),
    )


def _farthest(case: Case, known: Known) -> tuple[Case, float]:
    """The farther of two places, as the mixture has it: of a search from place to place by the
    sampler that sees the lobe, and of the places where all laws are asked."""
    at = survey(case)
    cosines = at.points.wo[:, 2].tolist()
    due = np.array([known(mu, at.at.sets.parameters(k)) for k, mu in enumerate(cosines)])
    scale = np.maximum(np.abs(due), SMALLEST)[:, None]
    k = _mixture.worst(at, at.reflected / scale, reflected_of, own=False, due=due[:, None] / scale)
    places = [_searched(case, known), at.place(k)]
    return max(places, key=functools.partial(_off, known))


def _off(known: Known, place: tuple[Case, float]) -> float:
    there, theta = place
    due = known(there.wo(theta)[2], there.one)
    e = _mixture.albedo(there, theta, Plan(samples=LOOK, seed=there.seed)).estimate
    return (abs(e.mean - due) - 2.0 * e.stderr) / max(abs(due), SMALLEST)


def _searched(case: Case, known: Known) -> tuple[Case, float]:
    space = worst.Space(case)
    value = worst.albedo(space, Quantity.ALBEDO)

    def deviation(at: Array, stage: worst.Stage) -> Array:
        due = np.array([known(space.vector(one)[2], space.parameters(one)) for one in at.tolist()])
        found: Array = np.abs(value(at, stage) - due) / np.maximum(np.abs(due), SMALLEST)
        return found

    at = worst.worst(space, deviation).at
    theta, phi = space.direction(at)
    return case._replace(p=space.parameters(at), phi_o_deg=phi), theta


def _cause(case: Case, p: Parameters, theta: float, due: float) -> str:
    """Where it deviates most, and how much there should be."""
    place = parameters.unlike(case, p) or f"most at {theta:.1f} degrees"
    return f"{place}: {due:.6g} is expected there"
