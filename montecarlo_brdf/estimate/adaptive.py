"""Adaptive estimates: the method is chosen from the model, samples double until the error is small.

The first look whose half-width is below the target ends it. Replicates that all miss a lobe agree
with each other, so a result also needs N large against the largest value that the integrand takes
at probed directions (measured: agreement of N with 2N accepts every missed lobe, the probe none).
"""
from __future__ import annotations

import functools
import math
from typing import NamedTuple

from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate import moments, quantity
from montecarlo_brdf.estimate.ascent import FIRST, Ascent, Method, Setting, looks_of
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import TARGETS, Choice, Plan, check_points
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import (
    charts_of,
    functions_of,
    identity_of,
    integrand,
    query,
    sampler_of,
    samplers_of,
)
from montecarlo_brdf.model import Model, ParameterSet, channels
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import PointSet
from montecarlo_brdf.statistics import Estimate, estimates_of
from montecarlo_brdf.vectors import Vec

LARGEST_NEED = 1 << 14  # samples of a replicate: beyond that the chart does not fit
#: of the error three looks before, from which replicates do not converge: to 8 times the samples,
#: two thirds of what lies between, even errors of independent points fall to 0.35
STALLED = 0.5
PROBING = 4  # replicates of the look that tells whether a method suits


class Outcome(NamedTuple):
    """Where looking with a method ended: the states of the kernel, and how far it got."""

    setting: Setting
    states: list[float]
    error: float  # largest relative half-width
    reached: bool
    misfit: str  # why the method does not fit, or nothing

    @property
    def complaint(self) -> str:
        """Why it did not get there."""
        told = f"does not fit: {self.misfit}" if self.misfit else f"only reached {self.error:.1e}"
        return f"{self.setting.method.sampler} x {self.setting.method.points} {told}"


def albedo(
    model: Model, p: ParameterSet, wo: Vec, plan: Plan, sampler: str = "cosine"
) -> tuple[list[Estimate], bool]:
    """Directional albedo per channel by a plan with a target or a method, and whether it got there.

    `sampler` is used where the plan chooses none.
    """
    model = model.of(p)
    if plan.target_error is not None:
        chosen = None
        if plan.method is Choice.GIVEN:
            chosen = Method(sampler_of(model, sampler), check_points(plan.points), "as given")
        return _until(model, p, wo, plan, chosen)
    best = suited(model, p, wo, plan)
    mean = integrand(model, Quantity.ALBEDO, best.sampler)
    fixed = plan._replace(points=best.points)
    rows = estimates(model, p, wo, [mean], fixed, ("albedo", best.sampler))
    return [row[0]._replace(method=told(best)) for row in rows], True


def _until(
    model: Model, p: ParameterSet, wo: Vec, plan: Plan, picked: Method | None
) -> tuple[list[Estimate], bool]:
    """Try methods until one reaches the target; the last word is the last one's."""
    tried: list[Outcome] = []
    for method in (picked,) if picked else methods(model):
        setting = prepare(model, p, hash(type(p)), method)
        tried.append(climb(setting, wo, plan, final=picked is not None))
        if tried[-1].reached:
            break
    # without success the method that fits and came closest
    best = min(tried, key=lambda t: (not t.reached, bool(t.misfit), t.error))
    story = told(best.setting.method, tuple(t.complaint for t in tried if not t.reached))
    return estimates_of(best.states, best.setting.channels, story), best.reached


def suited(model: Model, p: ParameterSet, wo: Vec, plan: Plan) -> Method:
    """The first method that the probe accepts for a fixed number of samples."""
    size = max(FIRST, plan.samples // max(1, plan.replicates))
    few = plan._replace(target_error=TARGETS[1], replicates=PROBING)
    for method in methods(model):
        ascent = Ascent(prepare(model, p, hash(type(p)), method), wo, few, hopeless=0.0)
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
        misfit = "" if reached else _misfit(ascent, setting.probed)
        if reached or ascent.ended() or (misfit and not final):
            return Outcome(setting, ascent.states, ascent.errors[-1], reached, misfit)


def _misfit(ascent: Ascent, chart: bool) -> str:
    """Why this method does not fit, or nothing."""
    errors = ascent.errors
    if ascent.need > LARGEST_NEED:
        return f"a probed value needs {ascent.need:.0e} samples"
    stalled = len(errors) > 4 and errors[-1] > STALLED * errors[-4]
    if chart and stalled and not ascent.ended():
        return "its replicates do not converge"
    return ""


@functools.lru_cache(maxsize=1024)
def methods(model: Model) -> list[Method]:
    """What to try, best first."""
    found = []
    for chart in charts_of(model)[:1]:
        kinked = chart is Sampler.PANELS
        what = "kinks" if kinked else f"{chart.replace('_', '-')} lobe"
        found.append(Method(chart, PointSet.LATTICE, f"the model declares its {what}"))
    if not found:
        why = "the model declares no lobe and no kinks"
        found.append(Method(Sampler.COSINE, PointSet.LATTICE, why))
    if Sampler.OWN in samplers_of(model):
        found.append(Method(Sampler.OWN, PointSet.SOBOL, "its own sampler sees every lobe"))
    return [*found, Method(Sampler.COSINE, PointSet.SOBOL, "nothing better fits")]


@functools.lru_cache(maxsize=256)
def told(method: Method, rejected: tuple[str, ...] = ()) -> str:
    """The method and why, as reports show it."""
    return "; ".join((f"{method.sampler} x {method.points}: {method.why}", *rejected))


@functools.lru_cache(maxsize=4096)
def prepare(model: Model, p: ParameterSet, kind: object, method: Method) -> Setting:
    """Kernel and numbers of a case. `kind` keeps equal tuples of different variants apart."""
    layout, numbers = pack([model.prepared(c) for c in channels(p)], moments.QUERY)
    mean = integrand(model, Quantity.ALBEDO, method.sampler)
    mean = mean.for_lattice() if method.points == PointSet.LATTICE else mean
    probe = quantity.probe_of(method.sampler, functions_of(model))
    identity = (method.points, *identity_of(model, p), "albedo")
    return Setting(
        method,
        mean,
        layout,
        looks_of(model.name, method.points, mean, probe, layout),
        probe is not None,
        tuple(numbers),
        query(model, p, (0.0, 0.0, 1.0))[3],
        "\x1f".join((*identity, method.sampler)),
        model.name,
    )
