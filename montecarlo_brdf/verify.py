"""From a question to a report: the calls behind the commands."""
from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from montecarlo_brdf.checks import furnace as furnace_check
from montecarlo_brdf.checks import identities as identities_check
from montecarlo_brdf.checks.case import Case
from montecarlo_brdf.checks.claim import Claim
from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.integration import probe
from montecarlo_brdf.integration.estimators import SAMPLERS, Plan, check_samples, check_theta, samplers_of
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.findings import Finding, Report, Result
from montecarlo_brdf.report.judge import decide
from montecarlo_brdf.sampling.points import SETS

ANGLES = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0)
SAMPLES = 1 << 22
#: fraction done of the whole run
Progress = Callable[[float], None]


def all_threads() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


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
    progress: Progress | None = None,
    curve: bool = False,
) -> Report:
    """White furnace test of a model with one or several parameter sets.

    p: a parameter set, a list of them, or None for the model's defaults. theta_o_deg: angles in
    [0, 90) degrees. sampler: "all" or some of "uniform", "cosine", "own". samples: the most that a
    claim may take; it stops sooner where it is decided. tolerance: relative for A, absolute for
    A <= 1. curve: add the reference at every degree, for pictures. Raises UserError for a bad value, ModelError if the model does not run.
    """
    sets = list(p) if isinstance(p, list) else [model.parameters() if p is None else p]
    angles = theta_o_deg if isinstance(theta_o_deg, (list, tuple)) else [theta_o_deg]
    angles = [check_theta(a) for a in angles]
    chosen = _samplers(model, sampler)
    plan = _plan(points, samples, seed, threads)
    _check_tolerance(tolerance)
    started = time.perf_counter()
    results = []
    for i, one in enumerate(sets):
        variant = model.of(one)
        probe.check(variant, one)
        case = Case(variant, one, angles, phi_o_deg, chosen, tolerance, seed=seed)
        share = _share(progress, i, len(sets))
        findings = _decided(
            furnace_check.claims(case), plan, variant, 2 * len(angles) * len(case.sets), share
        )
        curves = furnace_check.curves(variant, one, max(angles), phi_o_deg) if curve else []
        shown = shown_parameters(variant, one)
        results.append(Result(model.name, shown, "furnace", findings, curves))
    settings = {
        "theta_o_deg": list(angles),
        "phi_o_deg": phi_o_deg,
        "sampler": list(chosen),
        "tolerance": tolerance,
        **_settings(plan),
    }
    return _report("furnace", settings, results, started)


def identities(
    *,
    points: str = "sobol",
    samples: int = SAMPLES,
    seed: int = 0,
    threads: int | None = None,
    tolerance: float | None = None,
    progress: Progress | None = None,
) -> Report:
    """The identities of the hemisphere, each estimated and judged."""
    plan = _plan(points, samples, seed, threads)
    _check_tolerance(tolerance)
    started = time.perf_counter()
    claims = list(identities_check.claims(tolerance))
    findings = _decided(claims, plan, None, len(claims), progress)
    settings = {"tolerance": tolerance, **_settings(plan)}
    return _report("identities", settings, [Result("", {}, "identities", findings)], started)


def _decided(
    claims: Iterable[Claim], plan: Plan, model: Model | None, total: int, progress: Progress | None
) -> list[Finding]:
    findings = []
    for claim in claims:
        known = model.disclaims.get(getattr(claim, "property", "")) if model else None
        findings.append(decide(claim, plan, known))
        if progress:
            progress(min(1.0, len(findings) / total))
    return findings


def _report(command: str, settings: dict[str, Any], results: list[Result], started: float) -> Report:
    return Report(command, settings, results, {"seconds": time.perf_counter() - started})


def _settings(plan: Plan) -> dict[str, Any]:
    """What the results depend on; the number of threads is not among it."""
    return {"points": plan.points, "samples": plan.samples, "seed": plan.seed}


def _plan(points: str, samples: int, seed: int, threads: int | None) -> Plan:
    if points not in SETS:
        raise UserError(unknown("point set", points, SETS))
    threads = all_threads() if threads is None else threads
    if not isinstance(threads, int) or not 1 <= threads <= 1024:
        raise UserError(f"threads must be a whole number from 1 to 1024, not {threads}")
    if not isinstance(seed, int) or not 0 <= seed < 1 << 64:
        raise UserError(f"seed must be a whole number from 0 to 2^64 - 1, not {seed}")
    return Plan(points=points, samples=check_samples(samples), seed=seed, threads=threads)


def _samplers(model: Model, sampler: str | Sequence[str]) -> tuple[str, ...]:
    offered = samplers_of(model)
    if sampler == "all":
        return offered
    chosen = (sampler,) if isinstance(sampler, str) else tuple(sampler)
    for name in chosen:
        if name == "own" and name not in offered:
            raise UserError(f"model {model.name} has no sample and pdf, so no sampler of its own")
        if name not in offered:
            raise UserError(unknown("sampler", name, ("all", *SAMPLERS)))
    return chosen


def _check_tolerance(tolerance: float | None) -> None:
    if tolerance is not None and not 0.0 <= tolerance < 1.0:
        raise UserError(f"tolerance must be a number in [0, 1), not {tolerance}")


def shown_parameters(model: Model, p: Any) -> dict[str, Any]:
    """Parameters and choices by name, as reports print them."""
    return {**{model.labels.get(k, k): v for k, v in p._asdict().items()}, **model.picks}


def _share(progress: Progress | None, i: int, n: int) -> Progress | None:
    return (lambda done: progress((i + done) / n)) if progress else None
