"""brdf-check radiance"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.errors import UserError

EPILOG = """\b
Examples:
  brdf-check radiance examples/cook_torrance.toml
  brdf-check radiance --model ggx -p alpha=0.1 --environment cosine:8
  brdf-check radiance --model lambert --environment cap:10:60 --theta-o 0:80:9 --plot radiance.png
  brdf-check radiance examples/standard.toml --explain
"""


@click.command(
    "radiance", epilog=EPILOG, short_help="Reflected radiance of a scene, with verdicts."
)
@click.argument("scene", required=False, type=click.Path(path_type=Path))
@click.option(
    "--model",
    "spec",
    metavar="MODEL",
    shell_complete=_options.model_names,
    help="Without a scene file: the model of the surface. [--model ggx]",
)
@click.option(
    "-p",
    "--param",
    "assignments",
    multiple=True,
    metavar="NAME=VALUE",
    help="A parameter of the surface's model; a/b/c makes a colour. [-p alpha=0.1]",
)
@click.option(
    "--environment",
    metavar="SKY",
    help="Without a scene file: constant:L, cosine:EXPONENT, cap:HALF_ANGLE, gradient, "
    "quadratic, linear:A:B, each with :TILT in degrees, or image:FILE. [--environment cosine:8]",
)
@click.option(
    "--theta-o",
    "theta_o",
    metavar="DEGREES",
    help="Polar angles of the viewer in [0, 90) instead of the scene's. [--theta-o 0:85:18]",
)
@click.option("--explain", is_flag=True, help="Print what is evaluated, what is skipped, and why.")
@click.option("--no-skip", is_flag=True, help="Compute all of it the long way.")
@_options.sampling_options
@_options.output_options
@click.option(
    "--plot",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="L_o against angle with error bars and truth, as PNG, SVG or PDF. [--plot r.png]",
)
def command(**options: Any) -> int:
    """What radiance does a surface reflect towards the viewer, and is that what theory says?

    SCENE is a TOML file (docs/scenes.md). Per view and channel: L_o equals its analytic value or
    quadrature, and the surface's albedo is at most 1.
    """
    from montecarlo_brdf.cli._pictures import kind_of, plot
    from montecarlo_brdf.cli._progress import progress
    from montecarlo_brdf.verify.common import SAMPLES
    from montecarlo_brdf.verify.radiance import radiance

    _options.check_outputs(options["form"], options["export_json"], options["plot"])
    if options["plot"]:
        kind_of(options["plot"])
    made = scene_from(options)
    with progress(f"radiance {made.name}") as update:
        report = radiance(
            made,
            skip=not options["no_skip"],
            points=options["points"],
            samples=SAMPLES if options["samples"] is None else options["samples"],
            seed=_options.seed_of(options["seed"]),
            threads=options["threads"],
            tolerance=options["tolerance"],
            progress=update,
        )
    if options["plot"]:
        plot(report, options["plot"])
    if options["explain"] and options["form"] == "text":
        _explain(report.settings["plan"])
    sums = [f for f in report.results[0].findings if f.quantity.startswith("sum of weights")]
    for total in dict.fromkeys(f"{f.value:g}" for f in sums if f.verdict == "fail"):
        click.echo(f"Warning: the weights of the lobes add up to {total} > 1", err=True)
    return _options.deliver(
        report, options["form"], options["export_json"], options["inconclusive"], options["verbose"]
    )


def scene_from(options: dict[str, Any]) -> Any:
    """The scene of a file, or of --model and --environment."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.cli._values import numbers, parameter_sets
    from montecarlo_brdf.scene.make import scene_of, with_views
    from montecarlo_brdf.scene.read import read_scene

    path, spec, sky = options["scene"], options["spec"], options.get("environment")
    if path is not None and (spec or sky):
        raise UserError("give a scene file, or --model and --environment, not both")
    if path is None and not (spec and sky):
        raise UserError("give a scene file, or both --model and --environment")
    if path is not None:
        made = read_scene(path, **single_values(options["assignments"]))
    else:
        model = loading.load(spec)
        sets = parameter_sets(model, options["assignments"])
        if len(sets) != 1:
            raise UserError(f"radiance takes one value per parameter, not {len(sets)} sets")
        made = scene_of(model, sets[0], str(sky))
    if options["theta_o"]:
        made = with_views(made, numbers(options["theta_o"], "theta-o"))
    return made


def single_values(assignments: Any) -> dict[str, Any]:
    """-p name=value for the surface of a scene file; the model checks the values."""
    found: dict[str, Any] = {}
    for assignment in assignments:
        name, equals, text = assignment.partition("=")
        if not equals or not text:
            raise UserError(f"-p takes name=value, not {assignment!r}")
        found[name.strip()] = tuple(text.split("/")) if "/" in text else text
    return found


def _explain(rows: list[dict[str, Any]]) -> None:
    for row in rows:
        saved = f" (saves up to {row['samples_saved']:.3g} samples)" if row["samples_saved"] else ""
        click.echo(f"  {row['decision']:9}  {row['what']}: {row['why']}{saved}")
