"""brdf-check radiance"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Verdict

if TYPE_CHECKING:
    from montecarlo_brdf.scene.scene import Scene

EPILOG = """\b
Examples:
  brdf-check examples --copy examples
  brdf-check radiance examples/cook_torrance.toml
  brdf-check radiance --model ggx -p alpha=0.1 --environment cosine:8
  brdf-check radiance --model lambert --environment cap:10:60 --theta-o 0:80:9 --plot radiance.png
  brdf-check radiance examples/standard.toml --explain
"""


@click.command(
    "radiance", epilog=EPILOG, short_help="Reflected radiance of a scene, with verdicts."
)
@click.argument("scene", required=False, type=_options.FILE)
@_options.model(help="Without a scene file: the model of the surface. [--model ggx]")
@_options.parameters(
    help="A parameter of the surface's model; a/b/c makes a colour. [-p alpha=0.1]"
)
@click.option("--environment", metavar="SKY",
              help="Without a scene file: constant:L, cosine:EXPONENT, cap:HALF_ANGLE, gradient, "
              "quadratic, linear:A:B, each with :TILT in degrees, or image:FILE. "
              "[--environment cosine:8]")  # fmt: skip
@_options.theta_o(help="Polar angles of the viewer in [0, 90) instead of the scene's. "
                  "[--theta-o 0:85:18]")  # fmt: skip
@click.option("--explain", is_flag=True, help="Print what is evaluated, what is skipped, and why.")
@click.option("--no-skip", is_flag=True, help="Compute all of it the long way.")
@_options.sampling_options
@_options.output_options
@_options.plot(
    help="L_o against angle with error bars and truth, as PNG, SVG or PDF. [--plot r.png]"
)
def command(
    scene: Path | None, spec: str | None, assignments: tuple[str, ...], environment: str | None,
    theta_o: list[float] | None, explain: bool, no_skip: bool, sampling: _options.Sampling,
    output: _options.Output,
) -> int:  # fmt: skip
    """What radiance does a surface reflect towards the viewer, and is that what theory says?

    SCENE is a TOML file (brdf-check docs scenes). Per view and channel: L_o equals its analytic
    value or quadrature, what [expected] says, and the surface's albedo is at most 1.
    """
    from montecarlo_brdf.cli._terminal import progress
    from montecarlo_brdf.scene.read import with_views
    from montecarlo_brdf.verify.radiance import WEIGHTS, radiance

    made = scene_from(scene, spec, environment, assignments)
    output.check()
    if theta_o is not None:
        made = with_views(made, theta_o)
    with progress(f"radiance {made.name}") as update:
        report = radiance(made, skip=not no_skip, progress=update, **sampling.keywords())
    if explain and output.form == _options.TEXT:
        _explain(report.settings["plan"])
    sums = [f for f in report.results[0].findings if f.quantity == WEIGHTS]
    for total in dict.fromkeys(f"{f.value:g}" for f in sums if f.verdict == Verdict.FAIL):
        click.echo(f"Warning: the weights of the lobes add up to {total} > 1", err=True)
    return _options.deliver(report, output)


def scene_from(
    path: Path | None, spec: str | None, sky: str | None, assignments: tuple[str, ...]
) -> Scene:
    """The scene of a file, or of --model and --environment."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.scene.read import read_scene, scene_of

    if path is not None:
        if spec or sky:
            raise UserError("give a scene file, or --model and --environment, not both")
        return read_scene(path, **dict(map(_options.assigned, assignments)))
    if not (spec and sky):
        raise UserError("give a scene file, or both --model and --environment")
    model = loading.load(spec)
    sets = _options.parameter_sets(model, assignments)
    if len(sets) != 1:
        raise UserError(f"radiance takes one value per parameter, not {len(sets)} sets")
    return scene_of(model, sets[0], sky)


def _explain(rows: list[dict[str, Any]]) -> None:
    from montecarlo_brdf.cli._terminal import tell

    for row in rows:
        saved = f" (saves up to {row['samples_saved']:.3g} samples)" if row["samples_saved"] else ""
        tell(f"  {row['decision']:9}  {row['what']}: {row['why']}{saved}")
