"""A where it is farthest from what a model's file says of it, of all angles and free parameters."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import parameters, worst
from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.checks import _albedo
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Claim, Kind, MeanClaim, Reference
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

SMALLEST = 0.05  # albedo below which agreement is absolute


def farthest(
    case: Case, quantity: str, known: Callable[[float, Parameters], float], source: str
) -> Claim:
    """A equals `known(cos_theta_o, p)` where it is farthest from it."""
    space = worst.Space(case)
    value = worst.albedo(space, Quantity.ALBEDO)

    def expected(at: worst.At) -> float:
        return known(space.vector(at)[2], space.parameters(at))

    def deviation(at: Array, stage: worst.Stage) -> Array:
        due = np.array([expected(one) for one in at.tolist()])
        found: Array = np.abs(value(at, stage) - due) / np.maximum(np.abs(due), SMALLEST)
        return found

    at = worst.worst(space, deviation).at
    theta, phi = space.direction(at)
    there = case._replace(p=space.parameters(at), phi_o_deg=phi, free=())
    measured = functools.cache(functools.partial(_albedo.measure, there, theta))
    return MeanClaim(
        quantity,
        space.where(at, "o"),
        Bound.EQUAL,
        Reference(expected(at), 0.0, Kind.DECLARED, source),
        case.tolerated(AGREEMENT_TOLERANCE) * max(abs(expected(at)), SMALLEST),
        functools.partial(_albedo.of_channel, measured, 0),
        property=Property.REFERENCE,
        unit=_albedo.units(case.model, there.one),
        cause=functools.partial(_cause, case, there.one, theta, expected(at)),
    )


def _cause(case: Case, p: Parameters, theta: float, due: float) -> str:
    """Where it deviates most, and how much there should be."""
    place = parameters.unlike(case, p) or f"most at {theta:.1f} degrees"
    return f"{place}: {due:.6g} is expected there"
