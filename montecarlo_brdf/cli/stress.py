"""brdf-check stress"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._options import Read, finite, listed, numbers, parameter_sets
from montecarlo_brdf.errors import UserError

if TYPE_CHECKING:
    from montecarlo_brdf.model import Model

EPILOG = """\b
Examples:
  brdf-check stress --model ggx
  brdf-check stress --model my_brdf.py -p alpha=0.001 --precision float32 --max-error 1e-4
  brdf-check stress --compare textbook_ggx ggx --quick
  brdf-check stress --model ggx --plot digits.png
"""


@click.command("stress", epilog=EPILOG, short_help="Which digits survive in which precision.")
@_options.model(
    help="A built-in model, a specimen, my_brdf.py, my_brdf.py:name, or a shader. [--model ggx]"
)
@click.option("--compare", nargs=2, metavar="A B",
              help="Two models side by side. [--compare textbook_ggx ggx]")  # fmt: skip
@_options.parameters(
    help="A parameter or choice; without, the whole domain is searched. [-p alpha=0.01]"
)
@click.option("--precision", "precisions", type=Read(listed), metavar="NAMES",
              help="Judge only these: bfloat16, float16, float32, float64, longdouble. "
              "[--precision float16,float32]")  # fmt: skip
@click.option("--max-error", type=finite(), default=None,
              help="Relative error allowed [default: 1e-5 in single, 1e-13 in double]. "
              "[--max-error 1e-4]")  # fmt: skip
@click.option("--quick", is_flag=True, help="A few seconds: fewer points.")
@click.option("--at", metavar="X,Y,Z,X,Y,Z",
              help="Only evaluate f at this wo, wi, in every precision.")  # fmt: skip
@_options.plot(help="Heat maps of the error over angle and roughness. [--plot digits.png]")
@_options.output_options
def command(
    spec: str | None, compare: tuple[str, str] | None, assignments: tuple[str, ...],
    precisions: list[str] | None, max_error: float | None, quick: bool, at: str | None,
    output: _options.Output,
) -> int:  # fmt: skip
    """Run the model's own source in half, single, double and long double precision, and compare.

    The error of f is what the model's arithmetic adds to the rounding of its inputs, relative to f
    and beyond one rounding of the largest f seen from the same direction.
    """
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.stability.specimens import load
    from montecarlo_brdf.verify.stress import stress

    if bool(spec) == bool(compare):
        raise UserError("stress takes either --model MODEL or --compare A B")
    models = [load(one) for one in compare or (spec,) if one]
    output.check()
    sets = None
    if assignments:
        given = [parameter_sets(model, assignments) for model in models]
        models = [model.of(many[0]) for model, many in zip(models, given, strict=True)]
        sets = given[0]
    if at:
        return show_point(models[0], sets, at)
    with progress(f"stress {', '.join(m.name for m in models)}") as update:
        report = stress(
            models, sets, precisions=precisions, max_error=max_error, quick=quick, progress=update
        )
    return _options.deliver(report, output)


def show_point(model: Model, sets: Sequence[Any] | None, text: str) -> int:
    """f at one pair of directions in every precision, and its truth."""
    import numpy as np

    from montecarlo_brdf.arithmetic.rung import Rung, rounded, unit
    from montecarlo_brdf.arithmetic.types import exact, ladder
    from montecarlo_brdf.cli._terminal import tell

    components = numbers(text, "at")
    if len(components) != 6 or min(components[2], components[5]) <= 0.0:
        raise UserError("--at takes six numbers, wo and wi, both above the horizon")
    wo, wi = np.array([components[:3]]), np.array([components[3:]])
    p = sets[0] if sets else model.parameters()
    for one in ladder().values():
        q, value = rounded(p, one), math.nan
        if q is not None:
            value = float(Rung(model, one).f(one.array(wo), one.array(wi), q)[0])
        tell(f"{one.name:10} {value!r}")
    e = exact()
    truth = Rung(model, e).f(unit(wo, e), unit(wi, e), rounded(p, e))[0]
    tell(f"{'truth':10} {float(truth)!r}  (50 digits, these directions renormalised)")
    return 0
