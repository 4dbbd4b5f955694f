"""Energy: is ever more reflected than received?

R(wi), all that leaves for light from wi, and A(wo) are searched for their worst over angles up to 89.9
degrees and over the interior of the parameters' ranges: a coarse scan of both, then steps that climb
from the worst points. The worst is estimated again on a fresh stream and judged against 1. It cannot
see: a peak narrower than the scan.
"""
from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from montecarlo_brdf.checks import fitness, interiors, truth
from montecarlo_brdf.checks.case import Case
from montecarlo_brdf.checks.claim import BOUND_TOLERANCE, Claim, MeanClaim, Measurement, Reference
from montecarlo_brdf.integration import integrands
from montecarlo_brdf.integration.estimators import (
    Plan,
    Subject,
    estimates,
    evaluate,
    integrand_name,
    samplers_of,
)
from montecarlo_brdf.sampling.points import sobol
from montecarlo_brdf.vectors import Vec, from_degrees

NAME = "energy"
QUESTION = "is ever more reflected than received?"
PROPERTY = "energy"
ANGLES = (0.0, 30.0, 50.0, 65.0, 76.0, 84.0, 88.0, 89.9)
LAST = 89.9
INTERIOR = 20  # parameter sets of the scan
SCAN = Plan(samples=1 << 10, replicates=4)
CLIMB = Plan(samples=1 << 13, replicates=8)
POLISH = Plan(samples=1 << 16, replicates=8)
STEPS = {CLIMB: (0.15, 0.003), POLISH: (0.006, 0.0003)}  # first and last
QUANTITIES = {"albedo": "A", "reverse": "R"}


class Spot(NamedTuple):
    """An angle and the positions of the free parameters in their ranges, with the value there."""

    theta: float
    position: tuple[float, ...]
    value: float


def claims(case: Case) -> Iterator[Claim]:
    """The worst A and the worst R found are at most 1; per channel, never on the mean."""
    for quantity, symbol in QUANTITIES.items():
        for k, one in enumerate(case.sets):
            single = case._replace(p=one)
            spot = worst(single, quantity)
            p = parameters(single, spot)
            where = {f"theta_{'o' if quantity == 'albedo' else 'i'}_deg": round(spot.theta, 3)}
            where |= {"channel": k} if len(case.sets) > 1 else {}
            yield MeanClaim(
                f"worst {symbol} <= 1",
                {**where, **interiors.changed(single, p)},
                "at most",
                Reference(1.0, 0.0, "bound", "energy conservation"),
                case.tolerated(BOUND_TOLERANCE),
                functools.partial(_measure, single, quantity, p, spot.theta),
                property=PROPERTY,
                fallback=functools.partial(
                    truth.deterministic, case.model, p, _fixed(case, spot.theta), quantity == "reverse"
                ),
            )


def parameters(case: Case, spot: Spot) -> Any:
    """The parameter set of a spot."""
    return interiors.at(case, dict(zip(case.free, spot.position, strict=True))) if case.free else case.one


def worst(case: Case, quantity: str) -> Spot:
    """The worst spot: a scan over angles and interiors, then steps that shrink around the best two."""
    centre = tuple(interiors.position(case, case.one).values())
    positions = [centre]
    if case.free:
        rows = [sobol(case.seed + 0xE9, i) for i in range(INTERIOR)]
        positions += [tuple(u[k % 5] for k in range(len(case.free))) for u in rows]
    scanned = [_spot(case, quantity, t, at, SCAN) for at in positions for t in ANGLES]
    scanned.sort(key=lambda s: s.value, reverse=True)
    tops = (_climb(case, quantity, s, CLIMB) for s in scanned[:2])
    return _climb(case, quantity, max(tops, key=lambda s: s.value), POLISH)


def _climb(case: Case, quantity: str, spot: Spot, plan: Plan) -> Spot:
    """Steps to the best neighbour, halved where there is none better."""
    spot = _spot(case, quantity, spot.theta, spot.position, plan)
    step, last = STEPS[plan]
    while step > last:
        around = [_spot(case, quantity, t, at, plan) for t, at in _neighbours(spot, step)]
        best = max(around, key=lambda s: s.value)
        spot, step = (best, step) if best.value > spot.value else (spot, 0.5 * step)
    return spot


def _neighbours(spot: Spot, step: float) -> Iterator[tuple[float, tuple[float, ...]]]:
    """Steps along the angle and along each parameter."""
    for sign in (-1.0, 1.0):
        yield min(max(spot.theta + sign * 30.0 * step, 0.0), LAST), spot.position
        for k in range(len(spot.position)):
            moved = list(spot.position)
            moved[k] = min(max(moved[k] + sign * step, 0.0), 1.0)
            yield spot.theta, tuple(moved)


def _spot(case: Case, quantity: str, theta: float, position: tuple[float, ...], plan: Plan) -> Spot:
    """The value at a spot by the sampler that sees the lobe; the judge looks closer later.

    All spots use the same random numbers: differences between them are not noise.
    """
    model, p = case.model, parameters(case, Spot(theta, position, 0.0))
    sampler = samplers_of(model, quantity)[-1]
    integrand = getattr(integrands, integrand_name(model, quantity, sampler))
    bound = {"F": model.f, "SAMPLE": model.sample, "PDF": model.pdf}
    subject = Subject(
        (model.name,), {k: v for k, v in bound.items() if v is not None}, [model.prepared(p)]
    )
    e = evaluate(subject, _fixed(case, theta), [integrand], plan, (NAME, quantity), common=True)[0][0]
    return Spot(theta, position, e.mean if math.isfinite(e.mean) else math.inf)


def _fixed(case: Case, theta: float) -> Vec:
    return from_degrees(theta, case.phi_o_deg)


def _measure(case: Case, quantity: str, p: Any, theta: float, plan: Plan) -> list[Measurement]:
    """By every sampler that is fit."""
    model, fixed = case.model, _fixed(case, theta)
    chosen = samplers_of(model, quantity)
    names = [integrand_name(model, quantity, s) for s in chosen]
    row = estimates(model, p, fixed, names, plan, (NAME, quantity))[0]
    sight = fitness.look(model, model.prepared(p), fixed)
    return [
        Measurement(s, e, fitness.reason_unfit(s, e, sight, None))
        for s, e in zip(chosen, row, strict=True)
    ]
