"""White furnace: how much of a constant light 1 is reflected, and is that what theory says?

Two claims per angle: A(wo) equals its reference (or, without one, the estimators agree with each
other), and A(wo) is at most 1. Estimated by uniform, cosine and the model's own sampler; those
unfit for a case are listed and not used. It cannot see: errors that a constant light averages out,
and a non-reciprocal model's R(wi) > 1.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from typing import Any

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _truth
from montecarlo_brdf.estimate import adaptive, trust
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity, second_moment
from montecarlo_brdf.estimate.samplers import BLIND, integrand, samplers_of
from montecarlo_brdf.estimate.subject import functions_of
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import (
    AGREEMENT_TOLERANCE,
    BOUND_TOLERANCE,
    Claim,
    Exact,
    ExactClaim,
    MeanClaim,
    Reference,
)
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.vectors import Vec

NAME = "furnace"
QUESTION = "how much of a constant light is reflected, and is that what theory says?"
PROPERTY = "energy"
SMALLEST = 0.05  # albedo below which agreement is absolute


def claims(case: Case) -> Iterator[Claim]:
    """Two per angle and channel, and for a mixture that its weights add up to at most 1."""
    for theta in case.theta_o_deg:
        yield from at_angle(case, theta)
    if case.model.albedo and searchable(case):
        yield inside(case, "A elsewhere", lambda mu, p: float(case.model.albedo(mu, p)), "albedo()")
    for k, one in enumerate(case.sets if case.model.terms else []):
        yield _weights(case, one, {"channel": k} if len(case.sets) > 1 else {})


def at_angle(case: Case, theta: float) -> Iterator[MeanClaim]:
    """A equals its reference, and A <= 1; per channel."""
    measured = functools.cache(functools.partial(measure, case, theta))
    for k, one in enumerate(case.sets):
        where = case.where(theta_o_deg=theta)
        where |= {"channel": k} if len(case.sets) > 1 else {}
        expected = _truth.albedo(case.model, one, theta, case.phi_o_deg)
        scale = abs(expected.value) if expected else 1.0
        source = functools.partial(of_channel, measured, k)
        quadrature = functools.partial(_truth.deterministic, case.model, one, case.wo(theta))
        more = _fallback(case, one, theta, expected) if case.samplers is None else None
        yield MeanClaim(
            "A",
            where,
            "equal",
            expected,
            case.tolerated(AGREEMENT_TOLERANCE) * scale,
            source,
            unit=units(case.model, one),
            fallback=more,
        )
        yield MeanClaim(
            "A <= 1",
            where,
            "at most",
            Reference(1.0, 0.0, "bound", "energy conservation"),
            case.tolerated(BOUND_TOLERANCE),
            source,
            property=PROPERTY,
            unit=units(case.model, one),
            fallback=quadrature,
        )


def _fallback(
    case: Case, one: Any, theta: float, expected: Reference | None
) -> Callable[[int], Measurement] | None:
    """What is asked where samples leave "A equals its reference" open: a quadrature of f; where
    that is the reference, which says nothing about itself, draws that follow the lobe."""
    model, wo = case.model, case.wo(theta)
    if expected is not None and not expected.kind.startswith("quadrature"):
        return functools.partial(_truth.deterministic, model, one, wo)
    from montecarlo_brdf.checks import _slopes

    return functools.partial(_slopes.albedo, model, one, wo)


def searchable(case: Case) -> bool:
    """Whether to look beyond what was asked: not where somebody fixed every parameter."""
    return bool(case.free) or case.one == ()


def inside(case: Case, quantity: str, known: Any, source: str) -> Claim:
    """A where it is farthest from `known(cos_theta_o, p)`, of all angles and free parameters."""
    import numpy as np

    from montecarlo_brdf.cases import worst

    space = worst.Space(case)
    value = worst.albedo(space, Quantity.ALBEDO)

    def expected(at: Any) -> float:
        return known(space.vector(at)[2], space.parameters(at))

    def deviation(at: Any, stage: str) -> Any:
        due = np.array([expected(one) for one in at.tolist()])
        return np.abs(value(at, stage) - due) / np.maximum(np.abs(due), SMALLEST)

    at = worst.worst(space, deviation).at
    theta, phi = space.direction(at)
    there = case._replace(p=space.parameters(at), phi_o_deg=phi, free=())
    return MeanClaim(
        quantity,
        space.where(at, "o"),
        "equal",
        Reference(expected(at), 0.0, "declared", source),
        case.tolerated(AGREEMENT_TOLERANCE) * max(abs(expected(at)), SMALLEST),
        functools.partial(of_channel, functools.cache(functools.partial(measure, there, theta)), 0),
        property="reference",
        unit=units(case.model, there.one),
        cause=_elsewhere(case, there.one, theta, expected(at)),
    )


def _elsewhere(case: Case, p: Any, theta: float, due: float) -> str:
    """Where it deviates most, and how much there should be."""
    from montecarlo_brdf.cases import parameters

    place = parameters.unlike(case, p) or f"most at {theta:.1f} degrees"
    return f"{place}: {due:.6g} is expected there"


def _weights(case: Case, one: Any, where: dict[str, Any]) -> Claim:
    total = sum(float(getattr(one, f"{t.prefix}_weight")) for t in case.model.terms)
    return ExactClaim(
        "sum of weights <= 1",
        where,
        "at most",
        Reference(1.0, 0.0, "bound", "kd + ks <= 1"),
        1e-12,
        lambda: Exact(total, hint="the lobes together may reflect more than they receive"),
        property=PROPERTY,
    )


def curves(model: Model, p: Any, last: float, phi_deg: float) -> list[list[tuple[float, float]]]:
    """The reference at every degree up to `last`, per channel; nothing where there is none."""
    angles = [*(float(t) for t in range(90) if t < last), last]
    found = []
    for one in channels(p):
        truths = [(t, _truth.independent(model, one, t, phi_deg)) for t in angles]
        found.append([(t, known.value) for t, known in truths if known])
    return [curve for curve in found if curve]


def units(model: Model, one: Any) -> dict[str, float]:
    """What a hint may compare A with: the parameter that the model scales with."""
    names = [model.scales_with] if model.scales_with else list(one._fields)
    return {model.labels.get(n, n): getattr(one, n) for n in names if getattr(one, n)}


def of_channel(measured: Any, k: int, plan: Plan) -> list[Measurement]:
    """The measurements of channel k."""
    return list(measured(plan)[k])


def measure(case: Case, theta: float, plan: Plan) -> list[list[Measurement]]:
    """All estimators of A in one pass over the points, per channel."""
    model, wo = case.model, case.wo(theta)
    if plan.target_error is not None or plan.method == "auto":
        return _adaptive(model, case.p, wo, plan)
    chosen = [s for s in samplers_of(model) if case.samplers is None or s in case.samplers]
    means = [integrand(model, Quantity.ALBEDO, s) for s in chosen]
    blind = [s for s in chosen if s in BLIND]
    if model.sample and model.pdf:
        means += [second_moment(s, functions_of(model)) for s in blind]
    rows = estimates(model, case.p, wo, means, plan, (NAME,))
    result = []
    for row, one in zip(rows, case.sets, strict=True):
        sight = trust.look(model, one, wo)
        seconds = dict(zip(blind, row[len(chosen) :], strict=False))
        result.append(
            [
                trust.measured(s, e, sight, seconds.get(s))
                for s, e in zip(chosen, row, strict=False)
            ]
        )
    return result


def _adaptive(model: Model, p: Any, wo: Vec, plan: Plan) -> list[list[Measurement]]:
    """The method that fits best, per channel; unfit if it did not reach the error asked for."""
    found, reached = adaptive.albedo(model, p, wo, plan)
    unfit = None if reached else f"did not reach a relative error of {plan.target_error:g}"
    return [[Measurement(e.method.partition(":")[0], e, unfit)] for e in found]
