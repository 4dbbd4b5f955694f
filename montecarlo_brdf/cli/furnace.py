"""brdf-check furnace"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from montecarlo_brdf.cli import _options

if TYPE_CHECKING:
    from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.cli._values import Number

EPILOG = """\b
Examples:
  brdf-check furnace --model lambert
  brdf-check furnace --model lambert_unnormalised -p c=0.5
  brdf-check furnace --model my_brdf.py --theta-o 0:85:18 --plot albedo.png
  brdf-check furnace --model lambert -p albedo=0.9/0.5/0.1 --format json
  brdf-check furnace --model all
  brdf-check furnace --model ggx -p alpha=0.05 --target-error 1e-6
"""


@click.command("furnace", epilog=EPILOG, short_help="White furnace test: albedo against angle.")
@_options.model_option
@click.option(
    "--theta-o",
    "theta_o",
    default="0,15,30,45,60,75,85",
    show_default=True,
    metavar="DEGREES",
    help="Polar angles of the viewer in [0, 90): a list, or first:last:count. [--theta-o 0:85:18]",
)
@click.option("--phi-o", default="0", metavar="DEGREES", help="Azimuth of the viewer. [--phi-o 45]")
@click.option(
    "--sampler",
    default="all",
    show_default=True,
    metavar="NAMES",
    help="all, or some of uniform, cosine, own. [--sampler cosine,own]",
)
@click.option("--target-error", type=Number("in [1e-13, 1)"), default=None,
              help="Sample until the 99 % interval of A is as narrow, relative to A. "
              "[--target-error 1e-6]")  # fmt: skip
@click.option("--method", default=None, metavar="NAME",
              help="auto chooses chart or sampler and points for the model and tells why; given "
              "keeps --sampler and --points. [--method auto]  "
              "[default: auto with --target-error]")  # fmt: skip
@_options.sampling_options
@click.option("--resume", type=click.Path(path_type=Path), default=None, metavar="FILE",
              help="Keep partial sums in FILE, every ten seconds and at Ctrl-C, and go on from "
              "them: for billions of samples. [--resume sums.json]")  # fmt: skip
@_options.output_options
@click.option(
    "--plot",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Albedo against angle with error bars and reference, as PNG, SVG or PDF. [--plot a.png]",
)
def command(**options: Any) -> int:
    """How much of a constant light 1 does the surface reflect, and is that what theory says?

    Two claims per angle: the albedo A equals its reference within the tolerance, and A <= 1. Each
    is estimated by every sampler that can be trusted for the case.
    """
    from montecarlo_brdf.verify.resumption import partial_sums

    _options.check_outputs(options["form"], options["export_json"], options["plot"])
    if options["plot"]:
        from montecarlo_brdf.cli._pictures import kind_of, plot

        kind_of(options["plot"])
    with partial_sums(options["resume"]) as sums:
        report = gather(options, sums)
    if options["plot"]:
        plot(report, options["plot"])
    return _options.deliver(
        report, options["form"], options["export_json"], options["inconclusive"], options["verbose"]
    )


def gather(options: dict[str, Any], sums: Any = None) -> Report:
    """One report over all models asked for."""
    from montecarlo_brdf.cli._progress import progress
    from montecarlo_brdf.cli._values import models_of
    from montecarlo_brdf.judge.finding import Report

    specs = models_of(options["spec"])
    seed = _options.seed_of(options["seed"])
    reports = []
    with progress("furnace") as update:
        for k, spec in enumerate(specs):
            share = lambda done, k=k: update((k + done) / len(specs))  # noqa: E731
            reports.append(_one(spec, options, seed, share, sums))
    results = [result for r in reports for result in r.results]
    seconds = sum(r.measured["seconds"] for r in reports)
    return Report("furnace", reports[0].settings, results, {"seconds": seconds})


def _one(spec: str, options: dict[str, Any], seed: int, update: Any, sums: Any) -> Report:
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._values import number, numbers, parameter_sets
    from montecarlo_brdf.verify import furnace
    from montecarlo_brdf.verify.common import SAMPLES

    model = loading.load(spec)
    names = options["sampler"].split(",")
    return furnace.furnace(
        model,
        parameter_sets(model, options["assignments"]),
        numbers(options["theta_o"], "theta-o"),
        phi_o_deg=number(options["phi_o"], "phi-o"),
        sampler="all" if names == ["all"] else names,
        points=options["points"],
        samples=SAMPLES if options["samples"] is None else options["samples"],
        seed=seed,
        threads=options["threads"],
        tolerance=options["tolerance"],
        target_error=options["target_error"],
        method=options["method"],
        progress=update,
        curve=bool(options["plot"] or options["export_json"]),
        sums=sums,
    )
