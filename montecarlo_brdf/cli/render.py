"""brdf-check render"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._values import Whole
from montecarlo_brdf.errors import UserError

EPILOG = """\b
Examples:
  brdf-check render examples/cook_torrance.toml -o sphere.png
  brdf-check render --model ggx --furnace -p alpha=0.1:1:5 -o furnace.png
  brdf-check render examples/lambert.toml --furnace -o furnace.png -o furnace.npy
"""


@click.command(
    "render", epilog=EPILOG, short_help="A sphere under a scene's light; the furnace picture."
)
@click.argument("scene", required=False, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    "outputs",
    type=click.Path(path_type=Path),
    multiple=True,
    required=True,
    metavar="FILE",
    help="A .png picture; .npy or .exr for linear values. [-o sphere.png]",
)
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
    help="A parameter; lists and ranges make a row of spheres, two of them a grid. "
    "[-p alpha=0.1:1:5]",
)
@click.option(
    "--environment",
    metavar="SKY",
    help="Without a scene file: the sky, as for radiance. [--environment cap:20:45]",
)
@click.option(
    "--furnace",
    is_flag=True,
    help="Constant light 0.5 instead of the scene's: a lossless sphere disappears.",
)
@click.option(
    "--size", type=Whole(), default="512", show_default=True, help="Pixels across. [--size 256]"
)
@click.option(
    "--samples",
    type=Whole(),
    default="256",
    show_default=True,
    help="Samples per pixel where pixels are sampled. [--samples 1024]",
)
@click.option(
    "--camera",
    metavar="TILT[:AZIMUTH]",
    help="Where the viewer stands, degrees from the z axis. [--camera 90:-90]  "
    "[default: where the scene says, else on the axis]",
)
@click.option(
    "--seed",
    default="0",
    show_default=True,
    metavar="NUMBER",
    help="A number, or random. [--seed 7]",
)
@click.option(
    "--threads",
    type=Whole(),
    default=None,
    help="Threads; results do not depend on it. [--threads 1]",
)
def command(**options: Any) -> int:
    """Shade a sphere per pixel from the estimators, and say how exact the picture is.

    With --furnace a second panel shows the signed difference to the light from -10 % to +10 %. A
    picture is no verdict: see `brdf-check furnace` and `brdf-check radiance`.
    """
    from montecarlo_brdf.cli._progress import progress
    from montecarlo_brdf.cli._spheres import FURNACE, scenes_of
    from montecarlo_brdf.files import write_bytes
    from montecarlo_brdf.report.pictures import spheres
    from montecarlo_brdf.scene.render import render
    from montecarlo_brdf.vectors import from_degrees
    from montecarlo_brdf.verify.common import all_threads

    for path in options["outputs"]:
        _options.check_outputs("text", path)
        spheres.kind_of(path)
    for name, low, high in (("size", 8, 4096), ("samples", 1, 1 << 20)):
        if not low <= options[name] <= high:
            raise UserError(
                f"{name} must be a whole number from {low} to {high}, not {options[name]}"
            )
    camera = from_degrees(*_camera(options["camera"])) if options["camera"] else None
    cases, columns = scenes_of(options)
    made = []
    with progress("render") as update:
        for k, (label, scene) in enumerate(cases):
            shown = scene.under_constant_light(FURNACE) if options["furnace"] else scene
            one = render(
                shown,
                size=options["size"],
                samples=options["samples"],
                seed=_options.seed_of(options["seed"]),
                threads=options["threads"] or all_threads(),
                camera=camera,
                progress=lambda done, k=k: update((k + done) / len(cases)),  # type: ignore[misc]
            )
            made.append(one)
            click.echo(_said(label, one, options["furnace"]))
    labels = [label for label, _ in cases]
    for path in options["outputs"]:
        light = FURNACE if options["furnace"] else None
        kind = spheres.kind_of(path)
        write_bytes(path, spheres.drawn(kind, made, labels, light, columns))
    return 0


def _said(label: str, sphere: Any, furnace: bool) -> str:
    import numpy as np

    from montecarlo_brdf.cli._spheres import FURNACE

    shown = sphere.values[sphere.inside]
    text = f"{', '.join(label.splitlines())}: L_o from {shown.min():.6g} to {shown.max():.6g}"
    text += f", {sphere.how}, error up to {sphere.error:.1e}"
    if furnace:
        d = shown / FURNACE - 1.0
        form = "+.3%" if np.abs(d).max() > 1e-4 else "+.1e"
        text += f"; difference to the light {np.min(d):{form}} to {np.max(d):{form}}"
    return text


def _camera(text: str) -> tuple[float, ...]:
    from montecarlo_brdf.cli._values import number

    parts = [number(t, "camera") for t in text.split(":")]
    if len(parts) > 2 or not 0.0 <= parts[0] <= 180.0:
        raise UserError(f"camera is TILT[:AZIMUTH] with a tilt in [0, 180] degrees, not {text!r}")
    return tuple(parts)
