"""Adaptive estimates: the method is chosen from the model, samples double until the error is small.

The first look whose half-width is below the target ends it. Replicates that all miss a lobe agree
with each other, so a result also needs N large against the largest value that the integrand takes
at probed directions (measured: agreement of N with 2N accepts every missed lobe, the probe none).
"""
from __future__ import annotations

import math
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate.ascent import FIRST, Ascent
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.methods import Method, Setting, given, methods, prepare, told
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand
from montecarlo_brdf.model import Model
from montecarlo_brdf.statistics import Estimate, estimates_of
from montecarlo_brdf.vectors import Vec

LARGEST_NEED = 1 << 14  # samples of a replicate: beyond that the chart does not fit
TARGETS = (1e-13, 1.0)


class Outcome(NamedTuple):
    """Where looking ended: the states of the kernel, and why it ended there."""

    states: list[float]
    reached: bool
    complaint: str
    error: float  # largest relative half-width


def check_target(target: Any) -> float:
    """A relative error in [1e-13, 1), or a UserError."""
    low, high = TARGETS
    number = float(target) if isinstance(target, (int, float)) else math.nan
    if isinstance(target, bool) or not low <= number < high:
        allowed = f"a relative error in [{low:g}, {high:g})"
        raise UserError(f"target_error must be {allowed}, not {target}")
    return number


def check_plan(plan: Plan) -> None:
    """Raise UserError for a target or a method that is not allowed."""
    if plan.method not in ("auto", "given"):
        raise UserError(unknown("method", plan.method, ("auto", "given")))
    if plan.target_error is not None:
        check_target(plan.target_error)


def albedo(
    model: Model, p: Any, wo: Vec, plan: Plan, sampler: str = "cosine"
) -> tuple[list[Estimate], bool]:
    """Directional albedo per channel by a plan with a target or a method, and whether it got there.

    `sampler` is used with plan.method "given" only.
    """
    check_plan(plan)
    model = model.of(p)
    if plan.target_error is not None:
        picked = given(model, sampler, plan.points) if plan.method == "given" else None
        return _until(model, p, wo, plan, picked)
    best = suited(model, p, wo, plan)
    mean = integrand(model, Quantity.ALBEDO, best.sampler)
    fixed = plan._replace(points=best.points)
    rows = estimates(model, p, wo, [mean], fixed, ("albedo", best.sampler))
    return [row[0]._replace(method=told(best)) for row in rows], True


def _until(
    model: Model, p: Any, wo: Vec, plan: Plan, picked: Method | None
) -> tuple[list[Estimate], bool]:
    """Try methods until one reaches the target; the last word is the last one's."""
    tried: list[tuple[Setting, Outcome]] = []
    for method in (picked,) if picked else methods(model):
        setting = prepare(model, p, _kind(p), method)
        tried.append((setting, climb(setting, wo, plan, final=picked is not None)))
        if tried[-1][1].reached:
            break
    # without success the method that fits and came closest
    best, outcome = min(
        tried, key=lambda t: (not t[1].reached, "not fit" in t[1].complaint, t[1].error)
    )
    others = tuple(
        f"{s.method.sampler} x {s.method.points} {o.complaint}" for s, o in tried if o.complaint
    )
    story = told(best.method, others)
    return estimates_of(outcome.states, best.channels, story), outcome.reached


def _kind(p: Any) -> Any:
    return type(p)


def suited(model: Model, p: Any, wo: Vec, plan: Plan) -> Method:
    """The first method that the probe accepts for a fixed number of samples."""
    size = max(FIRST, plan.samples // max(1, plan.replicates))
    few = plan._replace(target_error=TARGETS[1], replicates=4)
    for method in methods(model):
        ascent = Ascent(prepare(model, p, _kind(p), method), wo, few, hopeless=0.0)
        ascent.look(1)
        if ascent.need <= size:
            return method
    return methods(model)[-1]


def climb(setting: Setting, wo: Vec, plan: Plan, final: bool) -> Outcome:
    """More and more samples until every channel is good enough, or the method turns out unfit."""
    ascent = Ascent(setting, wo, plan, math.inf if final else LARGEST_NEED)
    while True:
        ascent.climb(plan)
        reached = ascent.reached()
        complaint = "" if reached else _complaint(ascent, setting.probed)
        if reached or ascent.ended() or (complaint and not final):
            return Outcome(ascent.states, reached, complaint, ascent.errors[-1])


def _complaint(ascent: Ascent, chart: bool) -> str:
    """Why this method will not get there, or nothing."""
    errors = ascent.errors
    if ascent.need > LARGEST_NEED:
        return f"does not fit: a probed value needs {ascent.need:.0e} samples"
    if ascent.ended():
        return f"only reached {errors[-1]:.1e}"
    if chart and len(errors) > 4 and errors[-1] > 0.5 * errors[-4]:
        return "does not fit: its replicates do not converge"
    return ""
