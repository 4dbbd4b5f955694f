"""The furnace test of a model: directional albedo against angle."""
from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import furnace as furnace_check
from montecarlo_brdf.estimate import adaptive
from montecarlo_brdf.estimate.arguments import check_theta
from montecarlo_brdf.judge.finding import Report, Result
from montecarlo_brdf.model import Model
from montecarlo_brdf.verify.common import (
    SAMPLES,
    Progress,
    check_tolerance,
    chosen_samplers,
    decided,
    plan_settings,
    planned,
    reported,
    shared_progress,
    shown_parameters,
)
from montecarlo_brdf.verify.subject import probed, source

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

ANGLES = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0)


def furnace(
    model: Model,
    p: Any = None,
    theta_o_deg: Sequence[float] | float = ANGLES,
    *,
    phi_o_deg: float = 0.0,
    sampler: str | Sequence[str] = "all",
    points: str = "sobol",
    samples: int = SAMPLES,
    seed: int = 0,
    threads: int | None = None,
    tolerance: float | None = None,
    target_error: float | None = None,
    method: str | None = None,
    progress: Progress | None = None,
    curve: bool = False,
    sums: PartialSums | None = None,
) -> Report:
    """White furnace test of a model with one or several parameter sets.

    p: a parameter set, a list of them, or None for the model's defaults. theta_o_deg: angles in
    [0, 90) degrees. sampler: "all" or some of "uniform", "cosine", "own". samples: the most that a
    claim may take; it stops sooner where it is decided. tolerance: relative for A, absolute for
    A <= 1. target_error: relative; A is sampled until its 99 % interval is as narrow, by the method
    that fits the model best (method "auto", which without a target chooses for `samples`). curve:
    add the reference at every degree, for pictures. sums: `verify.resumption.partial_sums(file)`,
    where billions of samples survive an interruption. Raises UserError for a bad value, ModelError
    if the model does not run.
    """
    sets = list(p) if isinstance(p, list) else [model.parameters() if p is None else p]
    angles = theta_o_deg if isinstance(theta_o_deg, (list, tuple)) else [theta_o_deg]
    thetas = [check_theta(a) for a in angles]
    chosen = chosen_samplers(model, sampler)
    chosen_method = method or ("given" if target_error is None else "auto")
    plan = planned(points, samples, seed, threads)
    plan = plan._replace(target_error=target_error, method=chosen_method, sums=sums)
    adaptive.check_plan(plan)
    check_tolerance(tolerance)
    started = time.perf_counter()
    results = []
    for i, one in enumerate(sets):
        variant = model.of(one)
        probed(variant, one)
        only = None if sampler == "all" else chosen
        case = Case(variant, one, thetas, phi_o_deg, only, tolerance, seed=seed)
        share = shared_progress(progress, i, len(sets))
        findings = decided(
            furnace_check.claims(case), plan, variant, 2 * len(thetas) * len(case.sets), share
        )
        curves = furnace_check.curves(variant, one, max(thetas), phi_o_deg) if curve else []
        shown = shown_parameters(variant, one)
        results.append(Result(model.name, shown, "furnace", findings, curves, source(model)))
    settings = {
        "theta_o_deg": thetas,
        "phi_o_deg": phi_o_deg,
        "sampler": list(chosen),
        "tolerance": tolerance,
        **plan_settings(plan),
    }
    return reported("furnace", settings, results, started)
