"""Reflected radiance L_o of a planned scene: exact sums where they are possible, else estimates."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.compile.bind import bound
from montecarlo_brdf.compile.layout import Numbers
from montecarlo_brdf.estimate import probe, trust
from montecarlo_brdf.estimate.evaluate import evaluate
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Integrand
from montecarlo_brdf.estimate.samplers import Subject, members_of, weighted
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.model import Model, ParameterSet, Prepared
from montecarlo_brdf.sampling.points import DIMENSIONS
from montecarlo_brdf.scene import integrands, skies
from montecarlo_brdf.scene.plan import Method, ScenePlan, Work, unscaled
from montecarlo_brdf.scene.scene import Scene
from montecarlo_brdf.scene.surface import Lobe, ignores_directions
from montecarlo_brdf.statistics import FLOOR, Estimate
from montecarlo_brdf.vectors import Vec, mirrored


class Lit(NamedTuple):
    """What an integrand needs: prepared parameters of the model, and the sky's shape."""

    model: Prepared
    sky: Numbers


def measure(plan: ScenePlan, wo: Vec, sampling: Plan) -> list[Measurement]:
    """L_o towards wo, one measurement per channel."""
    exact = exact_part(plan, wo)
    parts: list[list[tuple[float, Estimate]]] = [[] for _ in exact]
    unfit: list[str | None] = [None] * len(exact)
    for work in plan.works:
        if work.method is Method.ONE_VALUE:
            _add_values(work, exact)
            continue
        estimates = _estimate(work, wo, sampling)
        for c, share in enumerate(work.shares):
            if share is not None:
                estimate, reason = estimates[share.place]
                parts[c].append((share.factor, estimate))
                unfit[c] = unfit[c] or (reason if share.factor else None)
    names = " + ".join(dict.fromkeys(w.method for w in plan.works)) or "exact sum"
    rows = zip(exact, parts, unfit, strict=True)
    return [Measurement(names, combined(e, p), reason) for e, p, reason in rows]


def combined(exact: float, parts: Sequence[tuple[float, Estimate]]) -> Estimate:
    """exact + sum of factor * estimate, added replicate by replicate."""
    if not parts:
        return Estimate(exact, FLOOR * abs(exact), 1, (exact,) * 16, exact * exact, exact)
    count = min(len(e.replicates) for _, e in parts)
    rows = [exact + math.fsum(f * e.replicates[k] for f, e in parts) for k in range(count)]
    mean = exact + math.fsum(f * e.mean for f, e in parts)
    spread = math.fsum((r - mean) ** 2 for r in rows)
    stderr = math.sqrt(spread / (count * (count - 1))) if count > 1 else math.inf
    floor = FLOOR * (abs(exact) + math.fsum(abs(f * e.mean) for f, e in parts))
    variance = math.fsum(f * f * max(0.0, e.second_moment - e.mean**2) for f, e in parts)
    samples = max(e.samples for _, e in parts)
    stderr = max(stderr, floor) if math.isfinite(mean) else math.nan
    return Estimate(mean, stderr, samples, tuple(rows), variance + mean * mean, mean)


def exact_part(plan: ScenePlan, wo: Vec) -> list[float]:
    """Emission, ambient and delta lights per channel."""
    scene = plan.scene
    total = list(scene.emission)
    if any(scene.ambient):
        colour = ambient_colour(scene)
        total = [t + a * k for t, a, k in zip(total, scene.ambient, colour, strict=True)]
    if not plan.lights:
        return total
    for lobe in plan.lobes:
        values = _values(lobe, plan, wo)
        for c, weight in enumerate(lobe.weights):
            terms = (
                f * light[c] * max(0.0, wi[2])
                for (wi, light), f in zip(plan.lights, values[c], strict=True)
            )
            total[c] += weight * math.fsum(terms)
    return total


def _values(lobe: Lobe, plan: ScenePlan, wo: Vec) -> list[list[float]]:
    """f per channel and light; channels that are multiples of each other share the calls."""
    known: dict[Any, list[float]] = {}
    rows = []
    for p in lobe.sets:
        unit, factor = unscaled(lobe.model, p) if plan.skip else (p, 1.0)
        if unit not in known or not plan.skip:
            known[unit] = [value_of(lobe.model, unit, wo, wi) for wi, _ in plan.lights]
        rows.append([factor * v for v in known[unit]])
    return rows


def value_of(model: Model, p: ParameterSet, wo: Vec, wi: Vec) -> float:
    """f(wo, wi) by the model's plain Python function; 0 below the horizon."""
    function = getattr(model.f, "py_func", model.f)
    above = (wi[0], wi[1], abs(wi[2]) or 5e-324)
    return float(probe.called(model, "f", function, wo, above, model.prepared(p)))


def ambient_colour(scene: Scene) -> list[float]:
    """What ambient light is multiplied with: the albedo of lobes that are the same everywhere."""
    total = [0.0] * scene.channels
    up = (0.0, 0.0, 1.0)
    for lobe in scene.surface.lobes:  # type: ignore[union-attr]
        if ignores_directions(lobe.model):
            for c, (weight, p) in enumerate(zip(lobe.weights, lobe.sets, strict=True)):
                total[c] += weight * math.pi * value_of(lobe.model, p, up, up)
    return total


def constant_values(work: Work) -> list[float]:
    """L_o of a constant f under a constant sky of 1, pi f, per parameter set."""
    up = (0.0, 0.0, 1.0)
    return [math.pi * value_of(work.model, p, up, up) for p, _ in work.sets]


def _add_values(work: Work, exact: list[float]) -> None:
    values = constant_values(work)
    for c, share in enumerate(work.shares):
        exact[c] += share.factor * values[share.place] if share else 0.0


def _estimate(work: Work, wo: Vec, sampling: Plan) -> list[tuple[Estimate, str | None]]:
    """One estimate per parameter set of a work, and why it must not be believed."""
    model = work.model
    sky = skies.FUNCTIONS[type(work.sets[0][1])]
    functions = {
        **members_of(model),
        "SKY": sky.radiance,
        "SKY_SAMPLE": sky.sample or integrands.cosine_sample,
        "SKY_PDF": sky.pdf or integrands.cosine_pdf,
    }
    template = bound(integrands.BY_METHOD[method_name(work)], **functions)
    mean = Integrand(template, (), None, DIMENSIONS, periodic=False)
    lit = (f"{p!r} {skies.identity(s)}" for p, s in work.sets)
    subject = Subject(
        model.name,
        (model.identity, *model.picks.values(), *lit),
        [Lit(model.prepared(p), shape) for p, shape in work.sets],
    )
    rows = evaluate(subject, wo, [mean], sampling, ("radiance", work.method))
    sets = zip(rows, work.sets, strict=True)
    return [(row[0], reason_unfit(work, row[0], p, shape, wo)) for row, (p, shape) in sets]


def method_name(work: Work) -> str:
    """Its integrand: that of the weight where the sampler has no pdf."""
    alone = work.method is Method.OWN and work.model.pdf is None and weighted(work.model)
    return "weighted" if alone else work.method


def reason_unfit(
    work: Work, e: Estimate, p: ParameterSet, shape: skies.Shape, wo: Vec
) -> str | None:
    """Too few samples met the light or the lobe for the error bar to be believed."""
    if not math.isfinite(e.mean) or skies.below_horizon(shape):
        return None
    if e.mean == 0.0 and not e.largest:
        return f"no sample of {e.samples} met light"
    unfit = (
        trust.unsquared(e)
        or trust.few_carry(work.method, e, e.second_moment)
        or _hidden(work, e, p, shape, wo)
    )
    return unfit.reason if unfit else None


def _hidden(
    work: Work, e: Estimate, p: ParameterSet, shape: skies.Shape, wo: Vec
) -> trust.Unfit | None:
    """A lobe of which directions know nothing."""
    if work.model.sample and work.method is not Method.SKY or ignores_directions(work.model):
        return None
    sky = skies.FUNCTIONS[type(shape)]
    at = mirrored(wo)
    density = sky.pdf(at, shape) if work.method is Method.SKY and sky.pdf else at[2] / math.pi
    highest, _ = probe.highest(work.model, work.model.prepared(p), wo)
    expected = highest * sky.radiance(at, shape) * at[2] / density if density else 0.0
    return trust.hardly_hit(work.method, e, expected)
