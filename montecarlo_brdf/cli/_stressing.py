"""What `stress` does once its options are known."""

from __future__ import annotations

import math
from typing import Any

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._progress import progress
from montecarlo_brdf.cli._values import numbers, parameter_sets
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.model import Model
from montecarlo_brdf.stability.specimens import load


def run_stress(options: dict[str, Any]) -> int:
    """Stress the models asked for and deliver the report; the exit code."""
    from montecarlo_brdf.verify.stress import stressed

    _options.check_outputs(options["form"], options["export_json"], options["plot"])
    models = models_of(options)
    given = (
        [parameter_sets(m, options["assignments"]) for m in models]
        if options["assignments"]
        else None
    )
    sets = given[0] if given else None
    if given:
        models = [m.of(many[0]) for m, many in zip(models, given, strict=False)]
    if options["at"]:
        return show_point(models[0], sets, options["at"])
    names = options["precisions"].split(",") if options["precisions"] else None
    with progress(f"stress {', '.join(m.name for m in models)}") as update:
        report, _ = stressed(
            models, sets, names, options["max_error"], options["quick"], update
        )
    if options["plot"]:
        from montecarlo_brdf.cli._pictures import plot

        plot(report, options["plot"])
    return _options.deliver(
        report, options["form"], options["export_json"], options["inconclusive"], options["verbose"]
    )


def models_of(options: dict[str, Any]) -> list[Model]:
    """The model of --model, or the two of --compare."""
    if bool(options["spec"]) == bool(options["compare"]):
        raise UserError("stress takes either --model MODEL or --compare A B")
    return [load(spec) for spec in options["compare"] or [options["spec"]]]


def show_point(model: Model, sets: Any, text: str) -> int:
    """f at one pair of directions in every precision, and its truth."""
    import numpy as np

    from montecarlo_brdf.stability.arithmetic import exact, ladder
    from montecarlo_brdf.stability.ladder import Rung, rounded, unit

    components = numbers(text, "at")
    if len(components) != 6 or min(components[2], components[5]) <= 0.0:
        raise UserError("--at takes six numbers, wo and wi, both above the horizon")
    wo, wi = np.array([components[:3]]), np.array([components[3:]])
    p = sets[0] if sets else model.parameters()
    for one in ladder().values():
        q = rounded(p, one)
        value = (
            math.nan if q is None else float(Rung(model, one).f(one.array(wo), one.array(wi), q)[0])
        )
        click.echo(f"{one.name:10} {value!r}")
    e = exact()
    truth = Rung(model, e).f(unit(wo, e), unit(wi, e), rounded(p, e))[0]
    click.echo(f"{'truth':10} {float(truth)!r}  (50 digits, these directions renormalised)")
    return 0
