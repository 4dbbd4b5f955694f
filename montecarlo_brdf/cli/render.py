"""brdf-check render"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from montecarlo_brdf.cli import _options
from montecarlo_brdf.cli._options import WHOLE, Value, axes, number, parameter_sets, values_of
from montecarlo_brdf.errors import UserError

if TYPE_CHECKING:
    from montecarlo_brdf.model import Model
    from montecarlo_brdf.scene.render import Sphere
    from montecarlo_brdf.scene.scene import Scene

FURNACE = 0.5  # radiance of the furnace: a lossless sphere disappears in its grey
MOST_SPHERES = 12

EPILOG = """\b
Examples:
  brdf-check examples --copy examples
  brdf-check render examples/cook_torrance.toml -o sphere.png
  brdf-check render --model ggx --furnace -p alpha=0.1:1:5 -o furnace.png
  brdf-check render examples/lambert.toml --furnace -o furnace.png -o furnace.npy
"""


@click.command(
    "render", epilog=EPILOG, short_help="A sphere under a scene's light; the furnace picture."
)
@click.argument("scene", required=False, type=_options.FILE)
@click.option("-o", "--output", "outputs", type=_options.FILE, multiple=True,
              required=True, metavar="FILE",
              help="A .png picture; .npy or .exr for linear values. [-o sphere.png]")  # fmt: skip
@_options.model(help="Without a scene file: the model of the surface. [--model ggx]")
@_options.parameters(
    help="A parameter; lists and ranges make a row of spheres, two of them a grid. "
    "[-p alpha=0.1:1:5]"
)
@click.option("--environment", metavar="SKY", help="Without a scene file: the sky, as for "
              "radiance. [--environment cap:20:45]")  # fmt: skip
@click.option("--furnace", is_flag=True,
              help="Constant light 0.5 instead of the scene's: a lossless sphere disappears.")
@click.option("--size", type=WHOLE, default="512", show_default=True,
              help="Pixels across each sphere. [--size 256]")  # fmt: skip
@click.option("--scale", type=_options.finite("above 0"), default=None,
              help="With --furnace: the difference at which the colours end [default: the largest "
              "there is]. [--scale 0.01]")  # fmt: skip
@click.option("--exposure", type=_options.finite(), default=0.0, show_default=True,
              help="Powers of two by which a .png is brighter. [--exposure 2]")  # fmt: skip
@click.option("--samples", type=WHOLE, default="256", show_default=True,
              help="Samples per pixel where pixels are sampled. [--samples 1024]")  # fmt: skip
@click.option("--camera", metavar="TILT[:AZIMUTH]",
              help="Where the viewer stands, degrees from the z axis. [--camera 90:-90]  "
              "[default: where the scene says, else on the axis]")  # fmt: skip
@_options.seed(help="A number, or random. [--seed 7]")
@_options.threads(help="Threads; results do not depend on it. [--threads 1]")
def command(
    scene: Path | None, outputs: tuple[Path, ...], spec: str | None, assignments: tuple[str, ...],
    environment: str | None, furnace: bool, size: int, scale: float | None, exposure: float,
    samples: int, camera: str | None, seed: int, threads: int | None,
) -> int:  # fmt: skip
    """Shade a sphere per pixel from the estimators, and say how exact the picture is.

    With --furnace a second panel shows the signed difference to the light, with its scale. A
    picture is no verdict: see `brdf-check furnace` and `brdf-check radiance`.
    """
    from montecarlo_brdf.cli._terminal import progress, tell
    from montecarlo_brdf.files import check_writable, write_bytes
    from montecarlo_brdf.report.pictures import spheres
    from montecarlo_brdf.scene.render import render
    from montecarlo_brdf.scene.scene import as_lobes
    from montecarlo_brdf.vectors import from_degrees
    from montecarlo_brdf.verify import failure
    from montecarlo_brdf.verify.question import all_threads, part_of

    for name, value, low, high in (("size", size, 8, 4096), ("samples", samples, 1, 1 << 20)):
        if not low <= value <= high:
            raise UserError(f"{name} must be a whole number from {low} to {high}, not {value}")
    if not (scale is None or 1e-6 <= scale <= 50.0) or abs(exposure) > 64.0:
        raise UserError("scale must be a number in [1e-6, 50], and exposure in [-64, 64]")
    viewer = from_degrees(*_camera(camera)) if camera else None
    sky = environment or (f"constant:{FURNACE}" if furnace else None)
    if scene is not None:
        if spec or environment:
            raise UserError("give a scene file, or --model and --environment, not both")
        scenes, columns = _from_file(scene, assignments)
    elif spec and sky:
        scenes, columns = _from_model(spec, sky, assignments)
    else:
        raise UserError("give a scene file, or --model with --environment or --furnace")
    for path in outputs:
        check_writable(path)
        spheres.kind_of(path)
    made = []
    with progress("render") as update:
        for k, (label, shown) in enumerate(scenes):
            with failure.of_lobes(as_lobes(shown).lobes):
                one = render(
                    shown.under_constant_light(FURNACE) if furnace else shown, size=size,
                    samples=samples, seed=seed, threads=threads or all_threads(), camera=viewer,
                    progress=part_of(update, k, len(scenes)),
                )  # fmt: skip
            made.append(one)
            tell(_said(label, one, samples, furnace))
    labels = [label for label, _ in scenes]
    for path in outputs:
        light = FURNACE if furnace else None
        content = spheres.drawn(
            spheres.kind_of(path), made, labels, light, columns, scale, exposure
        )
        write_bytes(path, content)
    return 0


def _said(label: str, sphere: Sphere, samples: int, furnace: bool) -> str:
    import numpy as np

    shown = sphere.values[sphere.inside]
    text = f"{', '.join(label.splitlines())}: L_o from {shown.min():.6g} to {shown.max():.6g}"
    exact = "of which no error is known" if samples == 1 and "per pixel" in sphere.how else "exact"
    text += f", {sphere.how}, " + (f"error up to {sphere.error:.1e}" if sphere.error else exact)
    if furnace:
        d = shown / FURNACE - 1.0
        form = "+.3%" if np.abs(d).max() > 1e-4 else "+.1e"
        text += f"; difference to the light {np.min(d):{form}} to {np.max(d):{form}}"
    return text


def _camera(text: str) -> tuple[float, ...]:
    parts = [number(t, "camera") for t in text.split(":")]
    if len(parts) > 2 or not 0.0 <= parts[0] <= 180.0:
        raise UserError(f"camera is TILT[:AZIMUTH] with a tilt in [0, 180] degrees, not {text!r}")
    return tuple(parts)


#: scenes with their labels, one per combination of parameters, and how many stand in a row
Page = tuple[list[tuple[str, "Scene"]], int]


def _from_model(spec: str, sky: str, assignments: Sequence[str]) -> Page:
    """A model under a sky, once per combination of -p values."""
    from montecarlo_brdf import loading
    from montecarlo_brdf.scene.read import scene_of

    model = loading.load(spec)
    columns = _columns(axes(assignments, lambda name: model))
    scenes = [
        (_label(spec, assignments, model.of(p), p), scene_of(model.of(p), p, sky))
        for p in parameter_sets(model, assignments)
    ]
    return scenes, columns


def _columns(listed: Mapping[str, Sequence[object]]) -> int:
    """Spheres in a row; complains if there are too many."""
    counts = [len(values) for values in listed.values()]
    total = math.prod(counts)
    if total > MOST_SPHERES:
        raise UserError(f"{total} spheres are more than the {MOST_SPHERES} that fit a picture")
    varied = [n for n in counts if n > 1]
    return varied[-1] if varied else 1


def _label(spec: str, assignments: Sequence[str], model: Model, p: NamedTuple) -> str:
    """The model, and the parameters and choices that were given."""
    from montecarlo_brdf.verify.question import shown_parameters

    values = shown_parameters(model, p)
    names = [a.partition("=")[0].strip() for a in assignments]
    rows = [f"{n} = {_shown(values[n])}" for n in names if n in values]
    return "\n".join([spec, ", ".join(rows)]) if rows else spec


def _shown(value: Value) -> str:
    if isinstance(value, tuple):
        return "/".join(map(_shown, value))
    return value if isinstance(value, str) else f"{value:.3g}"


def _from_file(path: Path, assignments: Sequence[str]) -> Page:
    """The scene once per combination of -p values, which replace those of its surface."""
    from montecarlo_brdf.scene.read import read_scene

    listed: dict[str, list[Value]] = {}
    for assignment in assignments:
        name, equals, text = (t.strip() for t in assignment.partition("="))
        if not equals or not text or name in listed:
            raise UserError(f"-p takes name=value, once per name, not {assignment!r}")
        listed[name] = values_of(name, text)
    columns = _columns(listed)
    scenes = []
    for row in itertools.product(*listed.values()):
        scene = read_scene(path, **dict(zip(listed, row, strict=True)))
        told = ", ".join(f"{n} = {_typed(v)}" for n, v in zip(listed, row, strict=True))
        scenes.append((f"{scene.name}\n{told}" if told else scene.name, scene))
    return scenes, columns


def _typed(value: Value) -> str:
    """A value as it was typed, a number of a range in three digits."""
    return "/".join(value) if isinstance(value, tuple) else _shown(value)
