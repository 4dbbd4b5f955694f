"""Limits: does the model become what it must where a parameter reaches an end?

A lossless model reflects exactly 1 at every angle, a lossless parameter set at those asked (a
mirror of width 1e-4 masks some light at 89.9 degrees); a declared limit equals another model
(roughness 0 is Lambert, equal widths are the isotropic lobe). It cannot see: limits nobody
declared.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator

from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.checks import _albedo, _deviation, _truth, equality
from montecarlo_brdf.judge.claim import (
    AGREEMENT_TOLERANCE,
    Claim,
    ExactClaim,
    Kind,
    MeanClaim,
    Reference,
    Skip,
)
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.loading import load
from montecarlo_brdf.model import Property

NAME = "limits"
QUESTION = "does it become what it must?"
PROPERTY = Property.REFERENCE


def claims(case: Case) -> Iterator[Claim]:
    """Lossless sets reflect 1; declared limits equal their model."""
    declared = list(case.model.limits)
    lossless = _lossless(case)
    if not declared and not lossless:
        yield Skip("limits", "the model declares no limits and no lossless parameter set")
    for p in lossless:
        yield from _lossless_claims(case, p)
    if case.model.lossless is True:
        yield _deviation.farthest(case, "A of a lossless surface", lambda mu, p: 1.0, "lossless")
    for changes, spec in declared:
        yield _limit(case, dict(changes), spec)


def _lossless(case: Case) -> list[Parameters]:
    """The parameter sets that must reflect exactly 1."""
    if case.model.lossless is True:
        return list(case.sets)
    return list(case.model.lossless or ())


def _lossless_claims(case: Case, p: Parameters) -> Iterator[Claim]:
    for theta in case.theta_o_deg:
        measure = functools.cache(functools.partial(_albedo.measure, case._replace(p=p), theta))
        yield MeanClaim(
            "A of a lossless surface",
            case.where(theta_o_deg=theta),
            Bound.EQUAL,
            Reference(1.0, 0.0, Kind.DECLARED, "lossless"),
            case.tolerated(AGREEMENT_TOLERANCE),
            functools.partial(_albedo.of_channel, measure, 0),
            property=PROPERTY,
            fallback=functools.partial(_truth.deterministic, case.model, p, case.wo(theta)),
        )


def _limit(case: Case, changes: dict[str, float], spec: str) -> Claim:
    said = ", ".join(f"{k} = {v:g}" for k, v in changes.items())
    free = tuple(n for n in case.free if n not in changes)
    there = case._replace(p=case.one._replace(**changes), free=free)
    return ExactClaim(
        f"|f - f of {spec}|/f at {said}",
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.DECLARED, f"becomes {spec}"),
        case.tolerated(equality.TOLERANCE),
        lambda: equality.difference(there, load(spec), spec),
        property=PROPERTY,
    )

