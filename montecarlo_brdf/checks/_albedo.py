"""A(wo) by every estimator, as several questions ask for it: their kernels are the same."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.estimate import adaptive, trust
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Choice, Plan
from montecarlo_brdf.estimate.quantity import Quantity, second_moment
from montecarlo_brdf.estimate.samplers import BLIND, functions_of, integrand, samplers_of
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.cases.case import Parameters

#: what gives the measurements of every channel
Measure = Callable[[Plan], list[list[Measurement]]]


def units(model: Model, one: Parameters) -> dict[str, float]:
    """What a hint may compare A with: the parameter that the model scales with, and no other."""
    names = [model.scales_with] if model.scales_with else []
    return {model.labels.get(n, n): getattr(one, n) for n in names if getattr(one, n)}


def of_channel(measured: Measure, k: int, plan: Plan) -> list[Measurement]:
    """The measurements of channel k."""
    return list(measured(plan)[k])


def measure(case: Case, theta: float, plan: Plan) -> list[list[Measurement]]:
    """All estimators of A in one pass over the points, per channel."""
    model, wo = case.model, case.wo(theta)
    if plan.target_error is not None or plan.method is Choice.AUTO:
        return _adaptive(model, case.p, wo, plan)
    chosen = [s for s in samplers_of(model) if case.samplers is None or s in case.samplers]
    means = [integrand(model, Quantity.ALBEDO, s) for s in chosen]
    blind = [s for s in chosen if s in BLIND]
    if model.sample and model.pdf:
        means += [second_moment(s, functions_of(model)) for s in blind]
    rows = estimates(model, case.p, wo, means, plan, ("furnace",))
    result = []
    for row, one in zip(rows, case.sets, strict=True):
        sight = trust.look(model, one, wo, Sampler.OWN in chosen)
        seconds = dict(zip(blind, row[len(chosen) :], strict=False))
        named = zip(chosen, row, strict=False)
        result.append([trust.measured(s, e, sight, seconds.get(s)) for s, e in named])
    return result


def _adaptive(model: Model, p: Parameters, wo: Vec, plan: Plan) -> list[list[Measurement]]:
    """The method that fits best, per channel; unfit if it did not reach the error asked for."""
    found, reached = adaptive.albedo(model, p, wo, plan)
    unfit = None if reached else f"did not reach a relative error of {plan.target_error:g}"
    return [[Measurement(e.method.partition(":")[0], e, unfit)] for e in found]
