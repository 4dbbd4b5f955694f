"""Does it hold under light that is not constant?

Reflected radiance under a cosine sky and under a tilted lobe of light, by every sampler that is
fit, against a quadrature of the same f (for a Lambert surface, against irradiance in closed form).
It sees what a constant furnace cancels: a wrong sampler with a wrong pdf that make the image look
right. It cannot see: an f that is wrong itself.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case, pointwise
from montecarlo_brdf.checks import _truth
from montecarlo_brdf.estimate import trust
from montecarlo_brdf.estimate.evaluate import evaluate
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quadrature import Integral
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand, samplers_of, subject_of, weighted
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Claim, MeanClaim, Reference, Skip
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "radiance"
QUESTION = "does it hold under light that is not constant?"
PROPERTY = Property.PDF
TOLERANCE = 10.0 * AGREEMENT_TOLERANCE
FARTHEST = 1000  # powers of 2 that a sky may be brighter or darker than 1


def cosine_sky(w: Vec) -> float:
    """L = cos(theta)."""
    return w[2]


def tilted_sky(w: Vec) -> float:
    """L = (1 + w . u)^2/4, with u tilted by 0.7 rad towards azimuth 0.8 rad: the plane of incidence
    divides it unequally, so that left and right are told apart."""
    c = 1.0 + w[0] * 0.4488307849786131 + w[1] * 0.4621334818051614 + w[2] * 0.7648421872844885
    return 0.25 * c * c


def either_sky(w: Vec, light: float) -> float:
    """As bright as a number says, whose sign chooses the sky: both share their kernels."""
    return light * cosine_sky(w) if light > 0.0 else -light * tilted_sky(w)


SKIES: dict[str, Callable[[Vec], float]] = {"cos": cosine_sky, "tilted": tilted_sky}
WHICH = {"cos": 1.0, "tilted": -1.0}


def claims(case: Case) -> Iterator[Claim]:
    """One per place and sky."""
    for there, theta, where in _places(case):
        for name in SKIES:
            afresh = functools.partial(_expected, there, theta, name)
            expected = afresh()
            if expected is None:
                yield Skip(
                    f"L_o, {name} sky", "the quadrature does not resolve f: nothing to compare with"
                )
                continue
            yield MeanClaim(
                f"L_o, {name} sky",
                where,
                Bound.EQUAL,
                expected,
                case.tolerated(TOLERANCE) * abs(expected.value),
                functools.partial(_measure, there, theta, name, _brightness(expected.value)),
                property=PROPERTY,
                fallback=_fallback(there, theta, name),
                afresh=afresh,
            )


def _places(case: Case) -> Iterator[tuple[Case, float, dict[str, Any]]]:
    """The angles asked about; for a sampler that returns its weight and has no pdf also other
    azimuths and parameters, as nothing else holds that weight against f."""
    for theta in case.theta_o_deg:
        yield case, theta, case.where(theta_o_deg=theta)
    if case.model.sample and case.model.pdf is None and weighted(case.model):
        for other, theta in parameters.elsewhere(case):
            yield other, theta, parameters.where(other, theta)


def _expected(case: Case, theta: float, name: str, seed: int = 0) -> Reference | None:
    return _truth.as_reference(_integral(case, theta, name, seed), TOLERANCE)


def _fallback(case: Case, theta: float, name: str) -> Callable[[int], Measurement] | None:
    """Another quadrature, where the model has no sampler that would be asked about."""
    own = Sampler.OWN in samplers_of(case.model)
    return None if own else functools.partial(_deterministic, case, theta, name)


def _deterministic(case: Case, theta: float, name: str, seed: int) -> Measurement:
    return _truth.as_measurement(*_integral(case, theta, name, 1 + seed))


def _integral(case: Case, theta: float, name: str, seed: int) -> Integral:
    wo, f, sky = case.wo(theta), pointwise(case.model, case.one).f, SKIES[name]
    fixed = np.array(wo)

    def lit(wi: Array) -> Array:
        light: Any = sky(wi.T)  # type: ignore[arg-type]  # of arrays too
        found: Array = f(fixed, wi) * wi[:, 2] * light
        return found

    seen = _truth.probes(case.model, case.one, wo, seed=seed)
    return _truth.integral(lit, wo, seen, seed, _truth.AIM * TOLERANCE)


def _brightness(expected: float) -> float:
    """Of a sky under which radiance is of the order of 1: squares of values are numbers then. A
    power of 2, which changes no digit."""
    power = math.frexp(expected)[1] if math.isfinite(expected) else 0
    return math.ldexp(1.0, max(-FARTHEST, min(FARTHEST, -power)))


def _measure(
    case: Case, theta: float, name: str, brightness: float, plan: Plan
) -> list[Measurement]:
    model, wo = case.model, case.wo(theta)
    chosen = samplers_of(model)
    means = [integrand(model, Quantity.RADIANCE, s, SKY=either_sky) for s in chosen]
    subject = subject_of(model, case.one)
    row = evaluate(subject, (*wo, brightness * WHICH[name]), means, plan, (name, NAME))[0]
    sight = trust.look(model, case.one, wo).under(brightness)
    found = [trust.measured(s, e, sight) for s, e in zip(chosen, row, strict=True)]
    return [one.times(1.0 / brightness) for one in found]
