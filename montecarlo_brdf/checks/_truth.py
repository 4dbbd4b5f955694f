"""The expected albedo of a model: declared in its file, our own reference, or a quadrature of f."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from montecarlo_brdf.cases.case import Parameters, pointwise
from montecarlo_brdf.estimate.probe import number_from
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Kind, Reference
from montecarlo_brdf.model import Model, Term
from montecarlo_brdf.statistics import Estimate
from montecarlo_brdf.truth import true_albedo
from montecarlo_brdf.vectors import Vec, from_degrees, mirrored

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array
    from montecarlo_brdf.estimate.mesh import Probes
    from montecarlo_brdf.estimate.quadrature import Integral

PROBES = 2048  # directions of a kind
ROUNDING = 4.0 * 2.0**-52
SOURCE = "adaptive quadrature"
RESOLVED = 0.25  # of a tolerance: what the error of a quadrature may take of it to judge by
QUOTABLE = AGREEMENT_TOLERANCE  # relative error up to which a quadrature is an estimator
AIM = 0.1 * RESOLVED  # of a tolerance: where f is smooth, errors of quadratures fall fast
TARGET = AIM * AGREEMENT_TOLERANCE


def albedo(
    model: Model, one: Parameters, theta_deg: float, phi_deg: float = 0.0, seed: int = 0
) -> Reference | None:
    """A(wo) as it should be; None if nothing can tell. seed: of the quadrature, where there is no
    other reference."""
    known = independent(model, one, theta_deg, phi_deg)
    return known or same_f(model, one, theta_deg, phi_deg, seed)


def independent(
    model: Model, one: Parameters, theta_deg: float, phi_deg: float = 0.0
) -> Reference | None:
    """A(wo) from a formula that is not the model's f: declared by the user, or our reference."""
    mu = from_degrees(theta_deg)[2]
    if model.albedo:
        return _declared(model, one, mu)
    if model.terms:
        parts = [
            (_weight(one, t), independent(t.model, t.parameters_of(one), theta_deg, phi_deg))
            for t in model.terms
        ]
        return _sum(parts)
    if not model.built_in:
        return None
    turned = {} if model.isotropic else {"phi_o": math.radians(phi_deg)}
    truth = true_albedo(model.name, mu, **one._asdict(), **model.picks, **turned)
    return Reference(*truth) if truth else None


def _declared(model: Model, one: Parameters, mu: float) -> Reference:
    """What the model's file says, to rounding at the size that it has elsewhere: a sum that cancels
    at one angle leaves that much there."""
    assert model.albedo is not None
    said = functools.partial(number_from, model, "albedo", model.albedo)
    value, *others = (said(m, one) for m in (mu, 0.1, 0.5, 1.0))
    size = max((abs(v) for v in others if math.isfinite(v)), default=0.0)
    return Reference(value, ROUNDING * size, Kind.DECLARED, f"albedo() of {model.name}")


def same_f(
    model: Model,
    one: Parameters,
    theta_deg: float,
    phi_deg: float = 0.0,
    seed: int = 0,
    target: float = TARGET,
    sure: bool = False,
) -> Reference | None:
    """A(wo) by a quadrature of f: it can refute samplers and estimators, not f itself.

    None where the quadrature does not resolve f well enough to judge anything by. Another seed
    gives another quadrature, to a relative error of `target` where that can be.
    sure: with an error that also covers another one.
    """
    fixed = from_degrees(theta_deg, phi_deg)
    found = quadrature(model, one, fixed, False, seed, target)
    if sure:
        found = covering(found, quadrature(model, one, fixed, False, seed + 1, target))
    return as_reference(found, AGREEMENT_TOLERANCE)


def as_reference(found: Integral, tolerance: float) -> Reference | None:
    """What a quadrature found, if it is sharp enough for a relative tolerance."""
    if not found.error <= RESOLVED * tolerance * abs(found.value):
        return None
    return Reference(found.value, found.error, Kind.SAME_F, SOURCE)


@functools.lru_cache(maxsize=1024)
def quadrature(
    model: Model,
    one: Parameters,
    fixed: Vec,
    reverse: bool = False,
    seed: int = 0,
    target: float = TARGET,
) -> Integral:
    """A(wo) or, reversed, R(wi)."""
    import numpy as np

    w = np.array(fixed)
    f = pointwise(model, one).f
    values = (lambda v: f(v, w)) if reverse else (lambda v: f(w, v))
    seen = probes(model, one, fixed, reverse, seed)
    return integral(lambda v: values(v) * v[:, 2], fixed, seen, seed, target)


def confirmed(model: Model, one: Parameters, fixed: Vec, reverse: bool = False) -> Integral:
    """The same, with an error that also covers another quadrature."""
    return covering(*(quadrature(model, one, fixed, reverse, seed) for seed in (0, 1)))


def covering(one: Integral, other: Integral) -> Integral:
    """The first of two, with an error that also covers the other."""
    return one._replace(error=max(one.error, abs(one.value - other.value) + other.error))


def integral(
    function: Callable[[Array], Array],
    wo: Vec,
    seen: Sequence[Probes],
    seed: int,
    target: float = TARGET,
) -> Integral:
    """int function(w) dw over the hemisphere, in half vectors with wo."""
    from montecarlo_brdf.estimate.quadrature import integrate
    from montecarlo_brdf.estimate.regions import Coordinates

    return integrate(function, Coordinates(wo), target, seen, seed)


def probes(
    model: Model, one: Parameters, fixed: Vec, reverse: bool = False, seed: int = 0
) -> tuple[Probes, ...]:
    """Directions that see what nodes do not: cosine-weighted, the model's own draws, and such as
    come ever nearer to the mirror direction and to the direction itself."""
    from montecarlo_brdf.estimate.quadrature import star

    own = () if reverse else own_probes(model, one, fixed, seed)
    return _cosine_probes(seed), star(mirrored(fixed)), star(fixed), *own


@functools.lru_cache(maxsize=4)
def _cosine_probes(seed: int) -> Probes:
    import numpy as np

    from montecarlo_brdf.estimate.mixture import cosine

    wi = cosine(_pilot(seed))
    return wi, np.pi / (PROBES * wi[:, 2])


def own_probes(
    model: Model, one: Parameters, fixed: Sequence[float] | Array, seed: int = 0
) -> tuple[Probes, ...]:
    """Draws of the model's sampler, and the solid angle that each stands for; none without one.

    Draws that are no unit vectors lie nowhere.
    """
    import numpy as np

    if not (model.sample and model.pdf):
        return ()
    drawn = _pilot_draws(model, one, tuple(map(float, fixed)), seed)
    density = pointwise(model, one).pdf(np.array(fixed), drawn)
    unit = np.abs(np.sum(drawn * drawn, axis=1) - 1.0) < 1e-3
    known = np.isfinite(density) & (density > 0.0) & unit
    return ((drawn[known], 1.0 / (PROBES * density[known])),)


def deterministic(
    model: Model, one: Parameters, fixed: Vec, seed: int = 0, *, reverse: bool = False
) -> Measurement:
    """The same as an estimator beside those that sample: every seed gives another quadrature than
    that of the reference."""
    return as_measurement(*quadrature(model, one, fixed, reverse, 1 + seed))


def as_measurement(value: float, error: float) -> Measurement:
    """What a quadrature found, as estimators say it."""
    e = Estimate(value, error, 0, (value, value), value * value, value)
    unfit = None if error <= QUOTABLE * abs(value) else f"the quadrature resolves only {error:.0e}"
    return Measurement("quadrature", e, unfit, error)


@functools.lru_cache(maxsize=8)
def _pilot_draws(model: Model, one: Parameters, wo: Vec, seed: int = 0) -> Array:
    """Draws of the model's sampler above the horizon."""
    import numpy as np

    drawn, _ = pointwise(model, one).sample(np.array(wo), _pilot(seed))
    above: Array = drawn[np.isfinite(drawn).all(axis=1) & (drawn[:, 2] > 0.0)]
    return above


@functools.lru_cache(maxsize=4)
def _pilot(seed: int) -> Array:
    import numpy as np

    return np.random.default_rng([PROBES, seed]).random((PROBES, 3))


def _weight(p: Parameters, term: Term) -> float:
    return float(getattr(p, f"{term.prefix}_weight"))


def _sum(parts: list[tuple[float, Reference | None]]) -> Reference | None:
    """The reference of a mixture: albedo is linear in f."""
    known = [(w, r) for w, r in parts if r is not None]
    if len(known) < len(parts):
        return None
    kinds = {r.kind for _, r in known}
    return Reference(
        math.fsum(w * r.value for w, r in known),
        math.fsum(w * r.error for w, r in known) + 1e-15,
        Kind.CLOSED_FORM if kinds == {Kind.CLOSED_FORM} else Kind.INDEPENDENT,
        " + ".join(dict.fromkeys(r.source for _, r in known)),
    )
