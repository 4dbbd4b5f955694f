"""Energy: is ever more reflected than received?

R(wi), all that leaves for light from wi, and A(wo) are searched for their worst over angles up to
89.9 degrees and over the parameters' ranges (cases.worst). The worst is estimated again on a
fresh stream and judged against 1. It cannot see: a peak narrower than the search.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator

import numpy as np

from montecarlo_brdf.cases import parameters, worst
from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.checks import _albedo, _truth
from montecarlo_brdf.estimate import trust
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand, samplers_of
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import BOUND_TOLERANCE, Claim, Kind, MeanClaim, Reference, Skip
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Model, Property
from montecarlo_brdf.vectors import Vec

NAME = "energy"
QUESTION = "is ever more reflected than received?"
PROPERTY = Property.ENERGY
QUANTITIES = {Quantity.ALBEDO: "A", Quantity.REVERSE: "R"}
UNDRAWN = (0.0, 45.0, 85.0)  # degrees at which a quadrature is asked too


def claims(case: Case) -> Iterator[Claim]:
    """The worst A and the worst R found are at most 1; per channel, never on the mean."""
    for quantity, symbol in QUANTITIES.items():
        for k, one in enumerate(case.sets):
            space = worst.Space(case._replace(p=one))
            channel = {"channel": k} if len(case.sets) > 1 else {}
            yield _claim(space, quantity, symbol, channel)
    yield from _unasked(case.model)


def _unasked(model: Model) -> Iterator[Claim]:
    """What no search reaches, so that nobody takes a pass for more than it is."""
    defaults = model.Params._field_defaults  # type: ignore[attr-defined]
    channels = {n for n, value in defaults.items() if isinstance(value, tuple)}
    for name in (n for n in model.Params._fields if n not in channels):  # type: ignore
        if not model.verified and not all(map(math.isfinite, model.domain.get(name, (math.inf,)))):
            reason = f"no other {name} is asked: declare a domain with two ends"
            yield Skip(f"other {name}", reason)
    for name, options in model.choices.items():
        others = ", ".join(o for o in options if o != model.picks[name])
        reason = f"no other {name} than {model.picks[name]} is asked: -p {name}=... for {others}"
        yield Skip(f"other {name}", reason)


def _claim(space: worst.Space, quantity: Quantity, symbol: str, channel: dict[str, int]) -> Claim:
    case, value = space.case, worst.albedo(space, quantity)
    spot = _undrawn(space, quantity, worst.worst(space, value))
    p, fixed = space.parameters(spot.at), space.vector(spot.at)
    theta, phi = space.direction(spot.at)
    reverse = quantity is Quantity.REVERSE
    there = case._replace(p=p, phi_o_deg=phi, samplers=None)
    return MeanClaim(
        f"worst {symbol} <= 1",
        {**space.where(spot.at, "i" if reverse else "o"), **channel},
        Bound.AT_MOST,
        Reference(1.0, 0.0, Kind.BOUND, "energy conservation"),
        case.tolerated(BOUND_TOLERANCE),
        functools.partial(_reverse, case.model, p, fixed)
        if reverse
        else functools.partial(_first, there, theta),
        property=PROPERTY,
        unit=_albedo.units(case.model, p),
        cause=functools.partial(_cause, space, spot, value),
        fallback=functools.partial(_truth.deterministic, case.model, p, fixed, reverse=reverse),
    )


def _undrawn(space: worst.Space, quantity: Quantity, spot: worst.Spot) -> worst.Spot:
    """A worse place by a quadrature of f, with parameters at the ends of their ranges and some
    inside: a search by the model's own sampler sees only what that draws."""
    case = space.case
    sets = (*parameters.extremes(case), *parameters.sets(case)) if case.model.sample else ()
    for p, theta in itertools.product(sets, UNDRAWN):
        position = parameters.position(case, p).values()
        at = (theta / worst.LAST, *(0.0,) * space.turning, *position)
        reverse = quantity is Quantity.REVERSE
        value, error = _truth.quadrature(case.model, p, space.vector(at), reverse)
        if value - 2.0 * error > max(1.0, spot.value):
            spot = worst.Spot(at, value)
    return spot


def _cause(space: worst.Space, spot: worst.Spot, value: worst.Value) -> str:
    """What the worst place says: towards grazing, inside the ranges only, or at which angle."""
    case, theta = space.case, space.direction(spot.at)[0]
    if theta > 85.0 and spot.value > 1.5:
        return "grows towards grazing: look at masking and at cosines in denominators"
    own = np.array([(*spot.at[: 1 + space.turning], *space.own())])
    if value(own, worst.Stage.ASCENT)[0] <= 1.0 + BOUND_TOLERANCE < spot.value:
        return parameters.unlike(case, space.parameters(spot.at))
    turned = f", azimuth {space.direction(spot.at)[1]:.0f}" if space.turning else ""
    return f"most at {theta:.1f} degrees{turned}: compare the normalisation, weights that add up"


def _first(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """A of the only channel by every sampler."""
    return _albedo.measure(case, theta, plan)[0]


def _reverse(model: Model, p: Parameters, wi: Vec, plan: Plan) -> list[Measurement]:
    """R by every sampler."""
    chosen = samplers_of(model, Quantity.REVERSE)
    means = [integrand(model, Quantity.REVERSE, s) for s in chosen]
    row = estimates(model, p, wi, means, plan, (NAME, "reverse"))[0]
    sight = trust.look(model, p, wi)
    return [trust.measured(s, e, sight) for s, e in zip(chosen, row, strict=True)]
