"""How a model keeps its digits in half, single, double and long double precision."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.model import Model
from montecarlo_brdf.report import stress as report_stress
from montecarlo_brdf.stability import designed
from montecarlo_brdf.stability.arithmetic import ladder, precision
from montecarlo_brdf.stability.stress import Outcome, outcome
from montecarlo_brdf.verify.common import Progress, reported


def stress(
    models: Model | Sequence[Model],
    p: Any = None,
    *,
    precisions: Sequence[str] | None = None,
    max_error: float | None = None,
    quick: bool = False,
    progress: Progress | None = None,
) -> Report:
    """Numerical stability of one or several models, as a Report.

    p: parameter sets, or None for a designed set over the whole domain. precisions: names of types
    that the models are held to; by default all are measured, single and double are judged.
    max_error: the relative error allowed, by default 1e-5 in single and 1e-13 in double.
    """
    return stressed(models, p, precisions, max_error, quick, progress)[0]


def stressed(
    models: Model | Sequence[Model],
    p: Any = None,
    precisions: Sequence[str] | None = None,
    max_error: float | None = None,
    quick: bool = False,
    progress: Progress | None = None,
) -> tuple[Report, list[tuple[Model, list[Outcome]]]]:
    """The report and the measurements it is made of, per model."""
    if max_error is not None and not 0.0 < max_error <= 1.0:
        raise UserError(f"max-error must be a number in (0, 1], not {max_error}")
    chosen = [precision(name) for name in precisions or ladder()]
    promised = tuple(precisions or report_stress.PROMISED)
    models = [models] if isinstance(models, Model) else list(models)
    started = time.perf_counter()
    found = []
    jobs = len(models) * len(chosen)
    for i, model in enumerate(models):
        sets = list(p) if p else designed.parameters(model, quick)
        many = []
        for k, arithmetic in enumerate(chosen):
            place = i * len(chosen) + k
            share = _share(progress, place, jobs)
            many.append(outcome(model, sets, arithmetic, max_error, quick, share))
        found.append((model, many))
    results = [report_stress.result(model, many, promised) for model, many in found]
    settings = {"precisions": [c.name for c in chosen], "max_error": max_error, "quick": quick}
    report = reported("stress", settings, results, started)
    report.measured["precisions"] = [[_measured(o) for o in many] for _, many in found]
    return report, found


def _measured(o: Outcome) -> dict[str, Any]:
    """What a precision did to a model, in numbers; NaN where no value of the parameter is safe."""
    parameter, safe = o.safe or (None, None)
    return {
        "name": o.precision,
        "eps": o.eps,
        "points": o.points,
        "worst": o.worst.own if o.worst else 0.0,
        "allowed": o.tolerance,
        "with_inputs": o.worst_total.total if o.worst_total else 0.0,
        **o.counts,
        "parameter": parameter,
        "safe": safe,
        "length": o.draws.length if o.draws else None,
    }


def _share(progress: Progress | None, place: int, jobs: int) -> Progress | None:
    return (lambda done: progress((place + done) / jobs)) if progress else None
