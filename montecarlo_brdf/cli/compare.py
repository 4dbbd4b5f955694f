"""brdf-check compare"""
from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from montecarlo_brdf.cli import _options

if TYPE_CHECKING:
    from montecarlo_brdf.model import Model

EPILOG = """\b
Examples:
  brdf-check compare my_ggx.py ggx -p alpha=0.1,0.5
  brdf-check compare ggx beckmann --theta-o 0:85:6 --tolerance 0.01
  brdf-check compare phong lafortune_willems --format markdown
  brdf-check compare my_fit.py ggx --declared 0.005
  brdf-check compare my_aniso.py 'ggx_anisotropic(alpha_x=ax, alpha_y=ay)'
"""


@click.command("compare", epilog=EPILOG, short_help="Two models' values, A and R side by side.")
@click.argument("model", metavar="A", shell_complete=_options.model_names)
@click.argument("other", metavar="B", shell_complete=_options.model_names)
@_options.parameters(help="A parameter or choice of A, of B, or of both if both have it. "
                     "[-p alpha=0.1]")  # fmt: skip
@_options.theta_o(default="0,15,30,45,60,75,85",
                  help="Angles in [0, 90) of the direction that is given. [--theta-o 0:85:18]")
@_options.phi_o(help="Its azimuth. [--phi-o 45]")
@_options.tolerance(help="Allowed relative deviation [default: 1e-6 of f, 1e-4 of A and R]. "
                    "[--tolerance 0.01]")  # fmt: skip
@click.option("--declared", type=_options.finite("above 0"), metavar="TOLERANCE",
              help="Only hold the albedo() that A declares, a fit or a table, against B's A: to "
              "this absolute tolerance. [--declared 0.005]")  # fmt: skip
@_options.seed(help="Of the random directions: a number, or random (printed). [--seed 7]")
@_options.output_options
@_options.plot(help="How near every finding came to its tolerance, as PNG, SVG or PDF. "
               "[--plot compare.png]")  # fmt: skip
def command(
    model: str, other: str, assignments: tuple[str, ...], theta_o: list[float], phi_o: float,
    tolerance: float | None, declared: float | None, seed: int, output: _options.Output,
) -> int:  # fmt: skip
    """Do two models agree? The columns estimate and expected are A's and B's.

    f is compared over thousands of pairs of directions, the albedo A(wo) and the reverse albedo
    R(wi) by quadrature with error bounds. Parameters have A's defaults, and without -p f is also
    searched over the ranges that both models have. "B(their=our)" maps parameters.
    """
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.counterpart import counterpart
    from montecarlo_brdf.verify.compare import compare

    first = loading.load(model)
    second = counterpart(other, first, known(first)) if "(" in other else loading.load(other)
    output.check()
    with progress(f"compare {first.name} {second.name}") as update:
        report = compare(
            first, second, pairs(first, second, assignments) if assignments else None, theta_o,
            phi_o_deg=phi_o, tolerance=tolerance, declared=declared, seed=seed, progress=update,
        )  # fmt: skip
    return _options.deliver(report, output)


def pairs(model: Model, other: Model, assignments: Sequence[str]) -> list[tuple[Any, Any]]:
    """Parameter sets of both for every combination; a value goes to whichever model knows it."""
    names = {m: set(known(m)) for m in (model, other)}
    owner = lambda name: other if name in names[other] - names[model] else model  # noqa: E731
    listed = _options.axes(assignments, owner)
    found = []
    for row in itertools.product(*listed.values()):
        values = dict(zip(listed, row, strict=True))
        # a name that neither has is the first one's to complain about
        own = {n: v for n, v in values.items() if n in names[model] or n not in names[other]}
        theirs = {n: v for n, v in values.items() if n in names[other]}
        found.append((model.parameters(**own), other.parameters(**theirs)))
    return found


def known(model: Model) -> list[str]:
    """Names of a model's parameters and choices, also those that its other choices would bring."""
    fields: tuple[str, ...] = model.Params._fields  # type: ignore[attr-defined]
    names = [model.labels.get(n, n) for n in fields]
    options = [option for picks in model.choices.values() for option in picks.values()]
    brought = [n for o in options if isinstance(o, dict) for n in o.get("params", {})]
    return [*names, *model.choices, *brought]
