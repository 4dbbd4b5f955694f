"""brdf-check converge"""
from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._values import Whole

EPILOG = """\b
Examples:
  brdf-check converge --model ggx -p alpha=0.3
  brdf-check converge --model oren_nayar --theta-o 60 --sampler panels,cosine --plot error.png
  brdf-check converge --model my_brdf.py --points sobol,independent --samples 2^18
"""


@click.command("converge", epilog=EPILOG, short_help="Error against samples: slopes and claims.")
@_options.model_option
@click.option("--theta-o", "theta_o", default="60", show_default=True, metavar="DEGREES",
              help="Polar angle of the viewer in [0, 90). [--theta-o 80]")  # fmt: skip
@click.option("--phi-o", default="0", metavar="DEGREES", help="Azimuth of the viewer. [--phi-o 45]")
@click.option("--sampler", default="all", show_default=True, metavar="NAMES",
              help="all, or some of uniform, cosine, own, half_vector, mirror, panels. "
              "[--sampler cosine,own]")  # fmt: skip
@click.option("--points", default="all", show_default=True, metavar="SETS",
              help="all, or some of independent, stratified, sobol, lattice. "
              "[--points sobol,lattice]")  # fmt: skip
@click.option("--samples", type=Whole(), default="2^21", show_default=True,
              help="The most samples of one point of a curve, over its 32 randomisations. "
              "[--samples 2^18]")  # fmt: skip
@click.option("--seed", default="0", show_default=True, metavar="NUMBER",
              help="A number, or random (printed). [--seed 7]")  # fmt: skip
@click.option("--threads", type=Whole(), default=None,
              help="Threads; results do not depend on it. [--threads 1]  "
              "[default: all]")  # fmt: skip
@_options.output_options
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE",
              help="Error against samples, log-log, as PNG, SVG or PDF. "
              "[--plot error.png]")  # fmt: skip
def command(**options: Any) -> int:
    """How fast does the error fall with the number of samples, and is that what theory says?

    One claim per sampler and point set: the slope of log error against log N. Tells the samples
    needed for errors of 1e-3, 1e-6 and 1e-9; in brackets where that is extrapolated.
    """
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._pictures import kind_of, plot
    from montecarlo_brdf.cli._progress import progress
    from montecarlo_brdf.cli._values import number, parameter_sets
    from montecarlo_brdf.verify.converge import converge

    _options.check_outputs(options["form"], options["export_json"], options["plot"])
    if options["plot"]:
        kind_of(options["plot"])
    model = loading.load(options["spec"])
    with progress(f"converge {model.name}") as update:
        report = converge(
            model,
            parameter_sets(model, options["assignments"]),
            number(options["theta_o"], "theta-o"),
            phi_o_deg=number(options["phi_o"], "phi-o"),
            sampler=_names(options["sampler"]),
            points=_names(options["points"]),
            samples=options["samples"],
            seed=_options.seed_of(options["seed"]),
            threads=options["threads"],
            progress=update,
        )
    if options["plot"]:
        plot(report, options["plot"])
    return _options.deliver(
        report, options["form"], options["export_json"], options["inconclusive"], options["verbose"]
    )


def _names(text: str) -> str | list[str]:
    return "all" if text == "all" else text.split(",")
