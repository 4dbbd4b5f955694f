"""What every question shares on its way to a report: settings, plans, deadlines, progress."""
from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate.arguments import check_samples
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.samplers import SAMPLERS, samplers_of
from montecarlo_brdf.judge.claim import Claim
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Finding, Report, Result
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.points import SETS

SAMPLES = 1 << 22
#: fraction done of the whole run
Progress = Callable[[float], None]


class Deadline:
    """A moment after which no new claim is begun."""

    def __init__(self, seconds: float) -> None:
        self._end = time.monotonic() + seconds

    def over(self) -> bool:
        """Whether the time is up."""
        return time.monotonic() > self._end


def all_threads() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def decided(
    claims: Iterable[Claim], plan: Plan, model: Model | None, total: int, progress: Progress | None
) -> list[Finding]:
    """The findings of all claims, in their order."""
    findings = []
    for claim in claims:
        known = model.disclaims.get(getattr(claim, "property", "")) if model else None
        findings.append(decide(claim, plan, known))
        if progress:
            progress(min(1.0, len(findings) / total))
    return findings


def reported(
    command: str, settings: dict[str, Any], results: list[Result], started: float
) -> Report:
    """A finished report; how long it took lies outside `results`."""
    return Report(command, settings, results, {"seconds": time.perf_counter() - started})


def plan_settings(plan: Plan) -> dict[str, Any]:
    """What the results depend on; the number of threads is not among it."""
    settings: dict[str, Any] = {"points": plan.points, "samples": plan.samples, "seed": plan.seed}
    if plan.effort != 1.0:
        settings["effort"] = plan.effort
    if plan.target_error is not None or plan.method != "given":
        settings |= {"target_error": plan.target_error, "method": plan.method}
    return settings


def planned(points: str, samples: int, seed: int, threads: int | None) -> Plan:
    """A sampling plan, or a UserError that says which value is not allowed."""
    if points not in SETS:
        raise UserError(unknown("point set", points, SETS))
    threads = all_threads() if threads is None else threads
    if not isinstance(threads, int) or not 1 <= threads <= 1024:
        raise UserError(f"threads must be a whole number from 1 to 1024, not {threads}")
    if not isinstance(seed, int) or not 0 <= seed < 1 << 64:
        raise UserError(f"seed must be a whole number from 0 to 2^64 - 1, not {seed}")
    return Plan(points=points, samples=check_samples(samples), seed=seed, threads=threads)


def chosen_samplers(model: Model, sampler: str | Sequence[str]) -> tuple[str, ...]:
    """The samplers asked for, if the model offers them."""
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


def check_tolerance(tolerance: float | None) -> None:
    """Raise UserError unless a tolerance is None or in [0, 1)."""
    if tolerance is not None and not 0.0 <= tolerance < 1.0:
        raise UserError(f"tolerance must be a number in [0, 1), not {tolerance}")


def check_effort(effort: float) -> float:
    """An effort in (0, 1], or a UserError."""
    if isinstance(effort, bool) or not (isinstance(effort, int | float) and 0.0 < effort <= 1.0):
        raise UserError(f"effort must be a number in (0, 1], not {effort}")
    return effort


def exactly(value: float) -> str:
    """A number with all its digits, and no more."""
    return f"{value:g}" if float(f"{value:g}") == value else repr(float(value))


def shown_parameters(model: Model, p: Any) -> dict[str, Any]:
    """Parameters and choices by name, as reports print them."""
    return {**{model.labels.get(k, k): v for k, v in p._asdict().items()}, **model.picks}


def shared_progress(progress: Progress | None, i: int, n: int) -> Progress | None:
    """The progress of part i out of n as progress of the whole."""
    return (lambda done: progress((i + done) / n)) if progress else None
