"""Adaptive estimates: the method is chosen from the model, samples double until the error is small.

A look at N samples per replicate spends its share of the error level on the interval of its
replicates; the first look whose half-width is below the target ends it. Replicates that all miss a
lobe agree with each other, so a result also needs N large against the largest value that the
integrand takes at probed directions (measured: agreement of N with 2N accepts every missed lobe,
the probe none).
"""
from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from montecarlo_brdf import student
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.integration import build, charted, kernel, parameters, work
from montecarlo_brdf.integration.estimators import (
    Plan,
    charts_of,
    compiled,
    estimates,
    integrand,
    integrand_name,
    query,
    samplers_of,
    suited_to,
)
from montecarlo_brdf.integration.kernel import STATE
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.sampling.points import NONE, SETS, SHAPES, Shape
from montecarlo_brdf.sampling.streams import stream
from montecarlo_brdf.statistics import FLOOR, Estimate, Moments, estimate
from montecarlo_brdf.vectors import Vec

LEVEL = 0.01  # of the interval that must be below the target, over all looks
FIRST = 64  # samples of a replicate at the first look,
FINE, FIRST_FINE = 1e-5, 256  # and where the target is finer than that: less has no chance
MOST = {"lattice": 20, "sobol": 20, "stratified": 20, "independent": 22}  # log2, the last look
SHARE = 0.25  # largest share of a replicate's total that a probed value may have
#: A sampler's weight may be 0 once in a million draws (a rejected direction) and 1 otherwise: until
#: one was seen all replicates agree. An event of probability `target` stays unseen in
#: SEEN/target samples with chance e^-SEEN. A probed chart has no such events.
SEEN = 10.0
LARGEST_NEED = 1 << 14  # samples of a replicate: beyond that the chart does not fit
TARGETS = (1e-13, 1.0)


class Method(NamedTuple):
    """A sampler or chart, a point set, and why they were picked."""

    sampler: str
    points: str
    why: str


class Setting(NamedTuple):
    """All that estimating a model with one parameter set needs, whatever the direction."""

    method: Method
    entry: Any
    probe: Any
    numbers: tuple[float, ...]
    width: float
    channels: int
    identity: tuple[str, ...]


class Climb(NamedTuple):
    """Where looking ended: moments per channel, and why it ended there."""

    rows: list[list[Moments]]
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


def albedo(
    model: Model, p: Any, wo: Vec, plan: Plan, sampler: str = "cosine"
) -> tuple[list[Estimate], bool]:
    """Directional albedo per channel by a plan with a target or a method, and whether it got there.

    `sampler` is used with plan.method "given" only.
    """
    check_plan(plan)
    model = model.of(p)
    if plan.target_error is not None:
        given = _given(model, sampler, plan.points) if plan.method == "given" else None
        return _until(model, p, wo, plan, given)
    best = suited(model, p, wo, plan)
    names = [integrand_name(model, "albedo", best.sampler)]
    fixed = plan._replace(points=best.points)
    rows = estimates(model, p, wo, names, fixed, ("albedo", best.sampler))
    return [row[0]._replace(method=told(best, [])) for row in rows], True


def check_plan(plan: Plan) -> None:
    """Raise UserError for a target or a method that is not allowed."""
    if plan.method not in ("auto", "given"):
        raise UserError(unknown("method", plan.method, ("auto", "given")))
    if plan.target_error is not None:
        check_target(plan.target_error)


def _given(model: Model, sampler: str, points: str) -> Method:
    offered = (*samplers_of(model), *charts_of(model))
    if sampler not in offered:
        raise UserError(unknown(f"sampler for model {model.name}", sampler, offered))
    if points not in SETS:
        raise UserError(unknown("point set", points, SETS))
    return Method(sampler, points, "as given")


@functools.lru_cache(maxsize=1024)
def methods(model: Model) -> list[Method]:
    """What to try, best first."""
    found = []
    for chart in charts_of(model)[:1]:
        what = "kinks" if chart == "panels" else f"{chart.replace('_', '-')} lobe"
        found.append(Method(chart, "lattice", f"the model declares its {what}"))
    if not found:
        found.append(Method("cosine", "lattice", "the model declares no lobe and no kinks"))
    if "own" in samplers_of(model):
        found.append(Method("own", "sobol", "its own sampler sees every lobe"))
    return [*found, Method("cosine", "sobol", "nothing better fits")]


def _until(
    model: Model, p: Any, wo: Vec, plan: Plan, picked: Method | None
) -> tuple[list[Estimate], bool]:
    """Try methods until one reaches the target; the last word is the last one's."""
    tried: list[tuple[Method, Climb]] = []
    for method in (picked,) if picked else methods(model):
        climb = _climb(prepare(model, p, _kind(p), method), wo, plan, final=picked is not None)
        tried.append((method, climb))
        if climb.reached:
            break
    # without success the method that fits and came closest
    best, climb = min(
        tried, key=lambda t: (not t[1].reached, "not fit" in t[1].complaint, t[1].error)
    )
    others = [f"{m.sampler} x {m.points} {c.complaint}" for m, c in tried if c.complaint]
    story = told(best, others)
    return [estimate(row)._replace(method=story) for row in climb.rows], climb.reached


def _kind(p: Any) -> Any:
    return type(p)


def told(method: Method, rejected: Sequence[str]) -> str:
    """The method and why, as reports show it."""
    return "; ".join((f"{method.sampler} x {method.points}: {method.why}", *rejected))


def suited(model: Model, p: Any, wo: Vec, plan: Plan) -> Method:
    """The first method that the probe accepts for a fixed number of samples."""
    size = max(FIRST, plan.samples // max(1, plan.replicates))
    for method in methods(model):
        setting = prepare(model, p, _kind(p), method)
        reals = (*wo, setting.width, *setting.numbers)
        job = work.Job(
            setting.entry, reals, setting.channels, 0, 4, FIRST, shape_of(method.points, FIRST)
        )
        means = [[m.mean for m in row] for row in work.run(job)]
        if _worst(means, _highest(setting, reals), 1)[1] <= size:
            return method
    return methods(model)[-1]


def shape_of(points: str, size: int) -> Shape:
    """What a point set must know beforehand."""
    return SHAPES[points](size) if points in SHAPES else NONE


@functools.lru_cache(maxsize=4096)
def prepare(model: Model, p: Any, kind: Any, method: Method) -> Setting:
    """Kernels and numbers of a case. `kind` keeps equal tuples of different variants apart."""
    name = integrand_name(model, "albedo", method.sampler)
    layout, numbers = parameters.pack([model.prepared(c) for c in channels(p)], kernel.QUERY)
    functions = {"F": model.f, "SAMPLE": model.sample, "PDF": model.pdf}
    bound = {k: v for k, v in functions.items() if v is not None}

    def entry(points: str, function: Any) -> Any:
        return compiled(model.name, build.Recipe(points, (function,), bound, layout))

    seen = getattr(charted, f"seen_{method.sampler}", None)
    return Setting(
        method,
        entry(method.points, suited_to(method.points, integrand(name))),
        entry("counted", seen) if seen else None,
        tuple(numbers),
        query(model, p, (0.0, 0.0, 1.0))[3],
        len(layout.places),
        (model.name, *model.picks.values(), *map(repr, p), "albedo", method.sampler),
    )


def _climb(setting: Setting, wo: Vec, plan: Plan, final: bool) -> Climb:
    """More and more samples until every channel is good enough, or the method turns out unfit."""
    points, width = setting.method.points, setting.channels
    reals = (*wo, setting.width, *setting.numbers)
    target = plan.target_error or 0.0
    key = stream(plan.seed, points, *setting.identity, *wo)
    ladder = work.Ladder(setting.entry, reals, width, key, plan.replicates)
    highest = _highest(setting, reals)
    fewest = 0.0 if setting.probe or not target else SEEN / (target * plan.replicates)
    most = min(1 << MOST[points], SETS[points][0])
    size = FIRST_FINE if target <= FINE else FIRST
    size = max(size, min(most, 1 << math.ceil(math.log2(max(1.0, fewest)))))
    errors = [math.inf] * 3
    while True:
        shape = shape_of(points, size)
        if size * plan.replicates > work.CHUNK:
            job = work.Job(setting.entry, reals, width, key, plan.replicates, size, shape)
            rows = zip(*work.run(job, plan.threads, None, plan.sums), strict=True)
            states = [x for row in rows for m in row for x in m]
        else:
            states = ladder.states(size, shape)
        means = [states[STATE * k + 1 :: STATE * width] for k in range(width)]
        worst, need = _worst(means, highest, len(errors) - 2)
        reached = worst <= target and max(need, fewest) <= size
        errors.append(worst)
        complaint = "" if reached else _complaint(errors, need, size >= most, bool(setting.probe))
        if reached or size >= most or (complaint and not final):
            return Climb(_moments(states, width), reached, complaint, worst)
        # an error falls by less than 32 when N doubles (slope -5): do not look where it cannot be
        size = min(most, size * (4 if worst > 32.0 * target else 2))


def _moments(states: list[float], width: int) -> list[list[Moments]]:
    """The states of a kernel as moments per channel and replicate."""
    columns = (states[i::STATE] for i in range(STATE))
    every = list(map(Moments._make, zip(*columns, strict=True)))
    return [every[k::width] for k in range(width)]


def _worst(
    means: Sequence[Sequence[float]], highest: Sequence[float], look: int
) -> tuple[float, float]:
    """(largest relative half-width, samples that the probed values demand) over the channels."""
    count = len(means[0])
    t = student.quantile(0.5 * LEVEL * 0.5**look, count - 1) / math.sqrt(count * (count - 1))
    floor = FLOOR * math.sqrt(count * (count - 1))
    worst, need = 0.0, 0.0
    for row, high in zip(means, highest, strict=True):
        mean = sum(row) / count
        size = abs(mean)
        half = t * max(math.sqrt(sum([(m - mean) * (m - mean) for m in row])), floor * size)
        # relative to the true value, which may be smaller than the mean by the half-width
        worst = max(worst, half / (size - half) if half < size else (math.inf if half else 0.0))
        need = max(need, high / (SHARE * size) if size else (math.inf if high else 0.0))
        if mean != mean:
            return math.inf, need
    return worst, need


def _complaint(errors: list[float], need: float, last: bool, chart: bool) -> str:
    """Why this method will not get there, or nothing."""
    if need > LARGEST_NEED:
        return f"does not fit: a probed value needs {need:.0e} samples"
    if last:
        return f"only reached {errors[-1]:.1e}"
    if chart and len(errors) > 7 and errors[-1] > 0.5 * errors[-4]:
        return "does not fit: its replicates do not converge"
    return ""


def _highest(setting: Setting, reals: Sequence[float]) -> list[float]:
    """The largest value of the integrand at probed directions, per channel."""
    if setting.probe is None:
        return [0.0] * setting.channels
    ladder = work.Ladder(setting.probe, reals, setting.channels, 0, 1)
    return ladder.states(charted.PROBES)[STATE - 1 :: STATE]
