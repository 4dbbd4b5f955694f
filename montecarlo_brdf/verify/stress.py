"""How a model keeps its digits in half, single, double and long double precision."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.arithmetic.types import ladder, precision
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.plan import Plan, Progress
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Command, Report, Result
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.stability import designed
from montecarlo_brdf.stability.claims import claims
from montecarlo_brdf.stability.stress import Loss, loss
from montecarlo_brdf.verify.question import part_of, reported

#: Precisions that a model is held to unless it is asked for others by name.
PROMISED = ("float32", "float64")
UNASKED = "measured, not promised: --precision {} makes it a claim"


def stress(
    models: Model | Sequence[Model], p: Sequence[NamedTuple] | None = None, *,
    precisions: Sequence[str] | None = None, max_error: float | None = None, quick: bool = False,
    progress: Progress | None = None,
) -> Report:  # fmt: skip
    """Numerical stability of one or several models.

    models: one, or several, from `load`. p: a list of parameter sets, or None for a designed one
    over the whole domain. precisions: names of types ("bfloat16", "float16", "float32", "float64",
    "longdouble") that the models are held to; None: all are measured, single and double judged.
    max_error: the relative error of f that is allowed, in (0, 1]; None for 1e-5 in single and 1e-13
    in double. quick: fewer points. progress: is called with the fraction done.

    Returns a Report with one Result per model. Raises UserError for a bad value, ModelError if f
    does not run in a precision.
    """
    if max_error is not None and not 0.0 < max_error <= 1.0:
        raise UserError(f"max-error must be a number in (0, 1], not {max_error}")
    asked = [precision(name) for name in precisions or ladder()]
    models = [models] if isinstance(models, Model) else list(models)
    started = time.perf_counter()
    found = []
    for i, model in enumerate(models):
        asked_of = list(p) if p else designed.parameters(model, quick)
        sets = [channel for one in asked_of for channel in channels(one)]
        many = []
        for k, one in enumerate(asked):
            part = part_of(progress, i * len(asked) + k, len(models) * len(asked))
            many.append(loss(model, sets, one, max_error, quick, part))
        found.append((model, many))
    results = [result(model, many, tuple(precisions or PROMISED)) for model, many in found]
    told = {"precisions": [one.name for one in asked], "max_error": max_error, "quick": quick}
    report = reported(Command.STRESS, told, results, started)
    report.measured["precisions"] = [[_numbers(one) for one in many] for _, many in found]
    return report


def _numbers(one: Loss) -> dict[str, Any]:
    """What a precision lost, for the table; NaN where no value of the parameter is safe."""
    parameter, safe = one.safe or (None, None)
    return {
        "name": one.precision, "eps": one.eps, "points": one.points,
        "worst": one.worst.own if one.worst else 0.0, "allowed": one.tolerance,
        "with_inputs": one.worst_total.total if one.worst_total else 0.0, **one.counts,
        "parameter": parameter, "safe": safe,
        "length": one.draws.length if one.draws else None,
    }  # fmt: skip


def result(model: Model, found: Sequence[Loss], promised: Sequence[str]) -> Result:
    """The findings of all precisions of one model; its curves are the heat maps."""
    findings = []
    for one in found:
        known = None if one.precision in promised else UNASKED.format(one.precision)
        findings += [decide(claim, Plan(), known) for claim in claims(model, one)]
    return Result(model.name, dict(model.picks), "stability", findings, [one.heat for one in found])
