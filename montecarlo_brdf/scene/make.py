"""A scene without a file: one model under one sky."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate.arguments import check_theta
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.scene.image import read_image
from montecarlo_brdf.scene.scene import Scene, View
from montecarlo_brdf.scene.sky_tables import RawSky, raw_image, read_sky
from montecarlo_brdf.scene.surface import Surface, lobes_of
from montecarlo_brdf.scene.toml import Table

SHORT = {
    "constant": "constant[:RADIANCE]",
    "gradient": "gradient[:TILT]",
    "linear": "linear:A:B[:TILT]",
    "quadratic": "quadratic[:TILT]",
    "cosine": "cosine:EXPONENT[:TILT]",
    "cap": "cap:HALF_ANGLE[:TILT]",
    "image": "image:FILE",
}


def short_sky(text: str) -> RawSky:
    """'cosine:8', 'cap:10:60': kind, its numbers, tilt of the axis in degrees."""
    kind, *rest = text.split(":")
    if kind not in SHORT:
        raise UserError(unknown("environment", kind, SHORT))
    if kind == "image":
        return raw_image(read_image(Path(":".join(rest))), 1.0)
    names = {
        "constant": ["radiance"],
        "linear": ["a", "b"],
        "cosine": ["exponent"],
        "cap": ["half_angle_deg"],
    }.get(kind, [])
    most = len(names) + (kind != "constant")
    try:
        numbers = [float(v) for v in rest]
    except ValueError:
        numbers = []
    if (
        len(numbers) != len(rest)
        or len(rest) > most
        or (kind in ("linear", "cap", "cosine") and len(rest) < len(names))
    ):
        raise UserError(f"environment {text!r} is not of the form {SHORT[kind]}")
    data: dict[str, Any] = {"kind": kind, **dict(zip(names, numbers, strict=False))}
    if len(numbers) > len(names):
        data["axis"] = {"tilt_deg": numbers[-1]}
    return read_sky(Table(Path("--environment"), "", data, ()))


def scene_of(
    model: Model, p: Any, environment: str, theta_o_deg: Sequence[float] = View().theta_o_deg
) -> Scene:
    """`model` with parameters `p` (colours allowed) under a sky like "cosine:8" or "cap:10:60"."""
    sky = short_sky(environment)
    widths = {len(channels(p)), sky.channels} - {1}
    if len(widths) > 1:
        raise UserError(
            f"the model has {len(channels(p))} channels and the environment {sky.channels}"
        )
    count = widths.pop() if widths else 1
    surface = Surface(tuple(lobes_of(model, p, (1.0,) * count, count)))
    dark = (0.0,) * count
    shown = {model.labels.get(k, k): v for k, v in p._asdict().items()} | dict(model.of(p).picks)
    name = f"{model.name} under {environment}"
    words = ("--model", model.name, *assigned(shown), "--environment", environment)
    scene = Scene(name, count, surface, sky.spread(count), ambient=dark, emission=dark, words=words)
    return with_views(scene, theta_o_deg)


def assigned(values: Mapping[str, Any]) -> list[str]:
    """-p name=value of every parameter."""
    rows = ((k, v if isinstance(v, tuple) else (v,)) for k, v in values.items())
    return [word for k, v in rows for word in ("-p", f"{k}={'/'.join(map(str, v))}")]


def with_views(scene: Scene, theta_o_deg: Sequence[float]) -> Scene:
    """The scene seen from other polar angles."""
    angles = tuple(check_theta(t) for t in theta_o_deg)
    return replace(scene, view=scene.view._replace(theta_o_deg=angles))
