"""An estimator for what uniform and cosine sampling hardly hit and quadratures cannot resolve.

For models without a sampler, and for densities with steps. Points spread over the slopes of half
vectors, with wo or with its mirror image, see a lobe of any width from 1e-3 on at the mirror
direction or at wo itself. It cannot see: a sharp lobe elsewhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from montecarlo_brdf.cases.case import Parameters, pointwise
from montecarlo_brdf.checks._truth import RETRO
from montecarlo_brdf.compile.bind import bound
from montecarlo_brdf.estimate import trust
from montecarlo_brdf.estimate.evaluate import evaluate
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Integrand, Quantity, integrand, sky_beside
from montecarlo_brdf.estimate.samplers import Subject
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import Vec, mirrored

#: light from a direction, of the sky that a number names
Sky = Callable[[Vec, float], float]
Place = Sequence[float]

NAME = "slopes"
SAMPLES = 1 << 20
AGREE = 6.0  # standard errors: what uniform directions miss of a sharp lobe is far more


def albedo(model: Model, one: Parameters, wo: Vec, seed: int) -> Measurement:
    """A(wo)."""
    side = side_of(model, one, wo)
    mean = integrand(Quantity.ALBEDO, Sampler.SLOPES, {"F": model.f})
    return _measured(model, one, (*wo, side), mean, seed)


def radiance(
    model: Model, one: Parameters, wo: Vec, sky: Sky, which: float, seed: int
) -> Measurement:
    """Reflected radiance under sky(w, which)."""
    place = (*wo, side_of(model, one, wo) * (1.0 + which))
    functions = {"F": model.f, "SKY": bound(sky_beside, SKY=sky)}
    mean = integrand(Quantity.RADIANCE, Sampler.SLOPES, functions)
    return _measured(model, one, place, mean, seed)


def mass(model: Model, one: Parameters, wo: Vec, seed: int) -> Measurement:
    """int pdf dwi; by uniform directions where those agree and are more precise."""
    slopes, uniform = (
        _measured(model, one, (*wo, 1.0), integrand(Quantity.MASS, s, {"PDF": model.pdf}), seed)
        for s in (Sampler.SLOPES, Sampler.UNIFORM)
    )
    a, b = slopes.estimate, uniform.estimate
    agree = abs(a.mean - b.mean) <= AGREE * math.hypot(a.stderr, b.stderr)
    return uniform._replace(estimator="uniform") if agree and b.stderr < a.stderr else slopes


def side_of(model: Model, one: Parameters, wo: Vec) -> float:
    """-1 where f is larger towards wo itself than towards its mirror direction, else 1."""
    import numpy as np

    both = pointwise(model, one).f(np.array(wo), np.array([wo, mirrored(wo)]))
    return -1.0 if both[0] > RETRO * both[1] else 1.0


def _measured(
    model: Model, one: Parameters, place: Place, mean: Integrand, seed: int
) -> Measurement:
    identity = (model.identity, *map(repr, one))
    subject = Subject(model.name, identity, [model.prepared(one)])
    e = evaluate(subject, place, [mean], Plan(samples=SAMPLES, seed=seed), (NAME,))[0][0]
    few = e.effective_samples() < trust.FEWEST
    return Measurement(NAME, e, "a lobe where half vectors do not show it" if few else None)
