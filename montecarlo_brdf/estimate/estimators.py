"""Estimators: a model, a direction and a sampler turned into an `Estimate`, never a bare float."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from montecarlo_brdf.compile.bind import Function
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import adaptive, quantity
from montecarlo_brdf.estimate.evaluate import estimates, evaluate
from montecarlo_brdf.estimate.plan import (
    REPLICATES,
    Choice,
    Plan,
    check_method,
    check_points,
    check_subject,
    check_theta,
)
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import BLIND, Subject, integrand, sampler_of
from montecarlo_brdf.model import Model, NoParams, ParameterSet
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.statistics import Estimate
from montecarlo_brdf.vectors import Vec, from_degrees


def directional_albedo(
    model: Model, p: ParameterSet | list[ParameterSet], theta_o_deg: float | Sequence[float], *,
    phi_o_deg: float = 0.0, sampler: str = "cosine", points: str = "sobol", samples: int = 1 << 16,
    seed: int = 0, replicates: int = REPLICATES, threads: int = 1,
    target_error: float | None = None, method: str | None = None,
) -> Any:  # fmt: skip
    """Directional albedo A(wo) = int f cos(theta_i) dwi, a number, with its error bar.

    model: from `load`. p: a parameter set of `model.parameters`, or a list of them. theta_o_deg,
    phi_o_deg: the viewer's polar angle in [0, 90), or a list of them, and azimuth, in degrees.
    sampler: "uniform", "cosine", "own" or a chart that fits the model ("half_vector", "mirror",
    "panels"). points: "independent", "stratified", "sobol" or "lattice".
    samples: the total over all replicates, 1 to 2^40. seed: 0 to 2^64 - 1. replicates: independent
    randomisations, whose spread is the error bar. threads: no result depends on their number.
    target_error: take as many samples as needed until the 99 % half-width is below this relative
    error, and choose sampler and points. method: "auto" chooses sampler and points, for `samples`
    without a target, and tells so in the estimate's `method`; "given" keeps those given; None for
    "auto" with a target.

    Returns an Estimate; a list of one per channel for a colour; for a list of angles or of
    parameter sets a list of that. Raises UserError for a bad value, ModelError if the model does
    not compile or raises.
    """
    rest = {k: v for k, v in locals().items() if k not in ("model", "p", "theta_o_deg")}
    if isinstance(p, list):
        return [directional_albedo(model, one, theta_o_deg, **rest) for one in p]
    if isinstance(theta_o_deg, (list, tuple)):
        return [directional_albedo(model, p, theta, **rest) for theta in theta_o_deg]
    check_subject(model, p)
    chosen = check_method(method, target_error)
    plan = Plan(check_points(points), samples, replicates, seed, threads, target_error, chosen)
    wo = from_degrees(check_theta(theta_o_deg), phi_o_deg)
    if target_error is None and chosen is Choice.GIVEN:
        return _one(model, p, Quantity.ALBEDO, wo, sampler, plan)
    found, _ = adaptive.albedo(model, p, wo, plan, sampler)
    return found[0] if len(found) == 1 else found


def reverse_albedo(
    model: Model, p: ParameterSet, theta_i_deg: float, *, phi_i_deg: float = 0.0,
    sampler: str = "cosine", points: str = "sobol", samples: int = 1 << 16, seed: int = 0,
    replicates: int = REPLICATES, threads: int = 1,
) -> Any:  # fmt: skip
    """Reverse albedo R(wi) = int f cos(theta_o) dwo: all the light that leaves, for light from wi.

    This is what energy conservation bounds by 1; it equals A only if f is reciprocal. model: from
    `load`. p: a parameter set of `model.parameters`. theta_i_deg, phi_i_deg: the light's polar
    angle in [0, 90) and azimuth, in degrees. sampler: "uniform", "cosine", "own" or a chart that
    fits the model. points: "independent", "stratified", "sobol" or "lattice".
    samples: the total over all replicates, 1 to 2^40. seed: 0 to 2^64 - 1. replicates: independent
    randomisations, whose spread is the error bar. threads: no result depends on their number.

    Returns an Estimate; a list of one per channel for a colour. Raises UserError for a bad value,
    ModelError if the model does not compile or raises.
    """
    check_subject(model, p)
    plan = Plan(check_points(points), samples, replicates, seed, threads)
    wi = from_degrees(check_theta(theta_i_deg, "theta_i_deg"), phi_i_deg)
    return _one(model, p, Quantity.REVERSE, wi, sampler, plan)


def bihemispherical_albedo(
    model: Model, p: ParameterSet, *, sampler: str = "cosine", points: str = "sobol",
    samples: int = 1 << 16, seed: int = 0, replicates: int = REPLICATES, threads: int = 1,
) -> Any:  # fmt: skip
    """Radiosity over irradiance under uniform light, 2 int A(mu) mu dmu, between 0 and 1.

    model: from `load`. p: a parameter set of `model.parameters`. sampler: "uniform", "cosine",
    "own" or a chart that fits the model. points: "independent", "stratified", "sobol" or "lattice".
    samples: the total over all replicates, 1 to 2^40. seed: 0 to 2^64 - 1. replicates: independent
    randomisations, whose spread is the error bar. threads: no result depends on their number.

    Returns an Estimate; a list of one per channel for a colour. Raises UserError for a bad value,
    ModelError if the model does not compile or raises.
    """
    check_subject(model, p)
    plan = Plan(check_points(points), samples, replicates, seed, threads)
    return _one(model, p, Quantity.BIHEMISPHERICAL, (0.0, 0.0, 1.0), sampler, plan)


def _one(model: Model, p: ParameterSet, of: Quantity, fixed: Vec, sampler: str, plan: Plan) -> Any:
    model = model.of(p)
    mean = integrand(model, of, sampler_of(model, sampler, of))
    rows = estimates(model, p, fixed, [mean], plan, (of, sampler))
    return rows[0][0] if len(rows) == 1 else [row[0] for row in rows]


def hemisphere_integral(
    function: Function, p: ParameterSet = NoParams(), *, sampler: str = "uniform",
    plan: Plan = Plan(),
) -> Estimate:  # fmt: skip
    """The integral of a function over the hemisphere, per solid angle.

    function: of a unit vector w and p; numba must be able to compile it. p: what it gets, a
    NamedTuple of numbers. sampler: "uniform" or "cosine". plan: how many points of which set.

    Returns an Estimate in the function's unit times sr. Raises UserError for another sampler,
    ModelError if the function does not compile or raises.
    """
    if sampler not in BLIND:
        raise UserError(unknown("sampler", sampler, BLIND))
    name = function.__qualname__
    subject = Subject(name, (name, *map(repr, p)), [p])
    mean = quantity.integrand(Quantity.HEMISPHERE, Sampler(sampler), {"F": function})
    return evaluate(subject, (0.0, 0.0, 1.0), [mean], plan, ("hemisphere", sampler))[0][0]
