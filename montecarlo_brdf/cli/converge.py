"""brdf-check converge"""
from __future__ import annotations

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._options import WHOLE, Read, listed, number, parameter_sets

EPILOG = """\b
Examples:
  brdf-check converge --model ggx -p alpha=0.3
  brdf-check converge --model oren_nayar --theta-o 60 --sampler panels,cosine --plot error.png
  brdf-check converge --model my_brdf.py --points sobol,independent --samples 2^18
"""


@click.command("converge", epilog=EPILOG, short_help="Error against samples: slopes and claims.")
@_options.model(required=True)
@_options.parameters()
@_options.theta_o(type=Read(number), default="60",
                  help="Polar angle of the viewer in [0, 90). [--theta-o 80]")  # fmt: skip
@_options.phi_o()
@click.option("--sampler", type=Read(listed), default="all", show_default=True, metavar="NAMES",
              shell_complete=_options.one_of(_options.sampler_names),
              help="all, or some of uniform, cosine, own, half_vector, mirror, panels. "
              "[--sampler cosine,own]")  # fmt: skip
@click.option("--points", type=Read(listed), default="all", show_default=True, metavar="SETS",
              shell_complete=_options.one_of(_options.point_sets),
              help="all, or some of independent, stratified, sobol, lattice. "
              "[--points sobol,lattice]")  # fmt: skip
@click.option("--samples", type=WHOLE, default="2^21", show_default=True,
              help="The most samples of one point of a curve, over its 32 randomisations. "
              "[--samples 2^18]")  # fmt: skip
@_options.seed()
@_options.threads()
@_options.output_options
@_options.plot(help="Error against samples, log-log, as PNG, SVG or PDF. [--plot error.png]")
def command(
    spec: str, assignments: tuple[str, ...], theta_o: float, phi_o: float, sampler: str | list[str],
    points: str | list[str], samples: int, seed: int, threads: int | None, output: _options.Output,
) -> int:  # fmt: skip
    """How fast does the error fall with the number of samples, and is that what theory says?

    One claim per sampler and point set: the slope of log error against log N. Tells the samples
    needed for errors of 1e-3, 1e-6 and 1e-9; in brackets where that is extrapolated.
    """
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.verify.converge import converge

    model = loading.load(spec)
    output.check()
    with progress(f"converge {model.name}") as update:
        report = converge(
            model, parameter_sets(model, assignments), theta_o, phi_o_deg=phi_o, sampler=sampler,
            points=points, samples=samples, seed=seed, threads=threads, progress=update,
        )  # fmt: skip
    return _options.deliver(report, output)
