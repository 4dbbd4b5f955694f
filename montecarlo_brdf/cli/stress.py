"""brdf-check stress"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._values import Number

EPILOG = """\b
Examples:
  brdf-check stress --model ggx
  brdf-check stress --model my_brdf.py -p alpha=0.001 --precision float32 --max-error 1e-4
  brdf-check stress --compare textbook_ggx ggx --quick
  brdf-check stress --model ggx --plot digits.png
"""


@click.command("stress", epilog=EPILOG, short_help="Which digits survive in which precision.")
@click.option(
    "--model",
    "spec",
    metavar="MODEL",
    shell_complete=_options.model_names,
    help="A built-in model, a specimen, my_brdf.py, or my_brdf.py:name. [--model ggx]",
)
@click.option(
    "--compare",
    nargs=2,
    metavar="A B",
    help="Two models side by side. [--compare textbook_ggx ggx]",
)
@click.option(
    "-p",
    "--param",
    "assignments",
    multiple=True,
    metavar="NAME=VALUE",
    help="A parameter or choice; without, the whole domain is searched. [-p alpha=0.01]",
)
@click.option(
    "--precision",
    "precisions",
    metavar="NAMES",
    help="Judge only these: bfloat16, float16, float32, float64, longdouble. "
    "[--precision float16,float32]",
)
@click.option(
    "--max-error",
    type=Number(),
    default=None,
    help="Relative error allowed [default: 1e-5 in single, 1e-13 in double]. [--max-error 1e-4]",
)
@click.option("--quick", is_flag=True, help="A few seconds: fewer points.")
@click.option(
    "--at", metavar="X,Y,Z,X,Y,Z", help="Only evaluate f at this wo, wi, in every precision."
)
@click.option(
    "--plot",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Heat maps of the error over angle and roughness. [--plot digits.png]",
)
@_options.output_options
def command(**options: Any) -> int:
    """Run the model's own source in half, single, double and long double precision, and compare.

    The error of f is what the model's arithmetic adds to the rounding of its inputs, relative to f
    and beyond one rounding of the largest f seen from the same direction.
    """
    from montecarlo_brdf.cli._stressing import run_stress

    return run_stress(options)
