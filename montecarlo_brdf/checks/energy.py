"""Energy: is ever more reflected than received?

R(wi), all that leaves for light from wi, and A(wo) are searched for their worst over angles up to
89.9 degrees and over the parameters' ranges (cases.worst), and at the places that all laws are
asked at (cases.survey). The worst is estimated again on a fresh stream and judged against 1. Only
what knows nothing of the sampler may refute f: one that contradicts its own pdf proves nothing.
It cannot see: an excess narrower than the search that no number or branch of the code names.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import parameters, worst
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.survey import Survey, reflected_of, survey
from montecarlo_brdf.checks import _albedo, _mixture, _truth
from montecarlo_brdf.estimate import trust
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand, samplers_of
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import BOUND_TOLERANCE, Claim, Kind, MeanClaim, Reference, Skip
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Model, Property

if TYPE_CHECKING:
    pass

NAME = "energy"
QUESTION = "is ever more reflected than received?"
PROPERTY = Property.ENERGY
QUANTITIES = {Quantity.ALBEDO: "A", Quantity.REVERSE: "R"}
LOOK = 1 << 14  # nodes by which two places are compared


def claims(case: Case) -> Iterator[Claim]:
    """The worst A and the worst R found are at most 1; per channel, never on the mean."""
    for quantity, symbol in QUANTITIES.items():
        for k, one in enumerate(case.sets):
            alone = case._replace(p=one)
            channel = {"channel": k} if len(case.sets) > 1 else {}
            yield _claim(alone, survey(alone), quantity, symbol, channel)
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


def _claim(case: Case, at: Survey, of: Quantity, symbol: str, channel: dict[str, int]) -> Claim:
    there, theta, value = _worst(case, at, of)
    reverse = of is Quantity.REVERSE
    letter = "i" if reverse else "o"
    turned = {f"phi_{letter}_deg": round(there.phi_o_deg, 3)} if there.phi_o_deg else {}
    place = {f"theta_{letter}_deg": round(theta, 3), **turned}
    return MeanClaim(
        f"worst {symbol} <= 1",
        {**place, **parameters.changed(case, there.one), **channel},
        Bound.AT_MOST,
        Reference(1.0, 0.0, Kind.BOUND, "energy conservation"),
        case.tolerated(BOUND_TOLERANCE),
        functools.partial(_reverse if reverse else _first, there, theta),
        property=PROPERTY,
        unit=_albedo.units(case.model, there.one),
        cause=functools.partial(_cause, case, there, theta, value, reverse),
        fallback=functools.partial(
            _truth.deterministic, case.model, there.one, there.wo(theta), reverse=reverse
        ),
        of_f=True,
    )


def _worst(case: Case, at: Survey, of: Quantity) -> tuple[Case, float, float]:
    """The worst of two places, as the mixture has it: that of a search from place to place by the
    sampler that sees the lobe, and that of the places where all laws are asked."""
    space = worst.Space(case)
    spot = worst.worst(space, worst.albedo(space, of))
    theta, phi = space.direction(spot.at)
    searched = case._replace(p=space.parameters(spot.at), phi_o_deg=phi, samplers=None)
    surveyed = at.place(_mixture.worst(at, at.reflected, reflected_of, own=False))
    places = [(searched, theta), surveyed]
    values = [_certain(there, t, of is Quantity.REVERSE) for there, t in places]
    k = int(np.argmax(values))
    return *places[k], values[k]


def _certain(there: Case, theta: float, reverse: bool) -> float:
    """What is reflected at least, two standard errors being taken off."""
    place = there.model, there.one, there.wo(theta)
    e = _mixture.reflected(*place, Plan(samples=LOOK, seed=there.seed), reverse).estimate
    return e.mean - 2.0 * e.stderr


def _cause(case: Case, there: Case, theta: float, value: float, reverse: bool) -> str:
    """What the worst place says: inside the ranges only, not at the normal, or at which angle."""
    if _certain(there._replace(p=case.one), theta, reverse) <= 1.0 < value:
        return parameters.unlike(case, there.one)
    if theta > 85.0 and _certain(there._replace(viewer=None), 0.0, reverse) <= 1.0:
        return f"at most 1 at the normal, {value:.4g} at {theta:.1f} degrees"
    turned = f", azimuth {there.phi_o_deg:.0f}" if not case.model.isotropic else ""
    return f"most at {theta:.1f} degrees{turned}"


def _first(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """A of the only channel by every sampler, and by the mixture."""
    return [*_albedo.measure(case, theta, plan)[0], _mixture.albedo(case, theta, plan)]


def _reverse(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """R the same way."""
    model, p, wi = case.model, case.one, case.wo(theta)
    chosen = samplers_of(model, Quantity.REVERSE)
    means = [integrand(model, Quantity.REVERSE, s) for s in chosen]
    row = estimates(model, p, wi, means, plan, (NAME, "reverse"))[0]
    sight = trust.look(model, p, wi)
    found = [trust.measured(s, e, sight) for s, e in zip(chosen, row, strict=True)]
    return [*found, _mixture.reflected(model, p, wi, plan, reverse=True)]
