"""White furnace: how much of a constant light 1 is reflected, and is that what theory says?

Two claims per angle: A(wo) equals its reference (or, without one, the estimators agree with each
other), and A(wo) is at most 1. Estimated by uniform, cosine and the model's own sampler; those
unfit for a case are listed and not used. It cannot see: errors that a constant light averages out,
and a non-reciprocal model's R(wi) > 1.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Any

from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.checks import _albedo, _truth
from montecarlo_brdf.judge.claim import (
    AGREEMENT_TOLERANCE,
    BOUND_TOLERANCE,
    Claim,
    Exact,
    ExactClaim,
    Kind,
    MeanClaim,
    Reference,
)
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Model, Property, channels

NAME = "furnace"
QUESTION = "how much of a constant light is reflected, and is that what theory says?"
PROPERTY = Property.ENERGY
#: albedos at angles in degrees
Curve = list[tuple[float, float]]
WEIGHTS_TOLERANCE = 1e-12  # of a sum of a few numbers: thousands of roundings


def claims(case: Case) -> Iterator[Claim]:
    """Two per angle and channel, and for a mixture that its weights add up to at most 1."""
    for theta in case.theta_o_deg:
        yield from at_angle(case, theta)
    if case.model.albedo and case.viewer is None and case.samplers is None:
        from montecarlo_brdf.checks import _deviation  # imports numpy

        known = case.model.albedo
        yield _deviation.farthest(
            case, "A elsewhere", lambda mu, p: float(known(mu, p)), "albedo()"
        )
    for k, one in enumerate(case.sets if case.model.terms else []):
        yield _weights(case, one, {"channel": k} if len(case.sets) > 1 else {})


def at_angle(case: Case, theta: float) -> Iterator[MeanClaim]:
    """A equals its reference, and A <= 1; per channel."""
    measured = functools.cache(functools.partial(_albedo.measure, case, theta))
    for k, one in enumerate(case.sets):
        where = case.where(theta_o_deg=theta)
        where |= {"channel": k} if len(case.sets) > 1 else {}
        expected = _truth.albedo(case.model, one, theta, case.phi_o_deg)
        scale = abs(expected.value) if expected else 1.0
        source = functools.partial(_albedo.of_channel, measured, k)
        quadrature = functools.partial(_truth.deterministic, case.model, one, case.wo(theta))
        yield MeanClaim(
            "A",
            where,
            Bound.EQUAL,
            expected,
            case.tolerated(AGREEMENT_TOLERANCE) * scale,
            source,
            unit=_albedo.units(case.model, one),
            diagnosis=functools.partial(_named, case, theta),
            fallback=quadrature if case.samplers is None else None,
            afresh=functools.partial(_truth.albedo, case.model, one, theta, case.phi_o_deg),
        )
        yield MeanClaim(
            "A <= 1",
            where,
            Bound.AT_MOST,
            Reference(1.0, 0.0, Kind.BOUND, "energy conservation"),
            case.tolerated(BOUND_TOLERANCE),
            source,
            property=PROPERTY,
            unit=_albedo.units(case.model, one),
            fallback=quadrature,
            of_f=True,
        )


def _named(case: Case, theta: float) -> str | None:
    """What is wrong with a pdf by which f cos/pdf is wrong too: its own check may be unable to
    integrate it, as 1/cos."""
    if not (case.model.sample and case.model.pdf):
        return None
    from montecarlo_brdf.checks import _density  # imports numpy

    return _density.ratio_cause(case, theta)


def _weights(case: Case, one: Parameters, where: dict[str, Any]) -> Claim:
    total = sum(float(getattr(one, f"{t.prefix}_weight")) for t in case.model.terms)
    return ExactClaim(
        "sum of weights <= 1",
        where,
        Bound.AT_MOST,
        Reference(1.0, 0.0, Kind.BOUND, "kd + ks <= 1"),
        WEIGHTS_TOLERANCE,
        lambda: Exact(total, hint="the lobes together may reflect more than they receive"),
        property=PROPERTY,
    )


def curves(model: Model, p: Parameters, last: float, phi_deg: float) -> list[Curve]:
    """The reference at every degree up to `last`, per channel; nothing where there is none."""
    angles = [*(float(t) for t in range(90) if t < last), last]
    found = []
    for one in channels(p):
        truths = [(t, _truth.independent(model, one, t, phi_deg)) for t in angles]
        found.append([(t, known.value) for t, known in truths if known])
    return [curve for curve in found if curve]
