"""Skies as they are written: [environment] of a scene file, and its short form on a command line.

A sky that is read has one shape and one scale, or one per channel.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.colour import Colour, spread
from montecarlo_brdf.scene.images import read_image
from montecarlo_brdf.scene.skies import Sky
from montecarlo_brdf.scene.table import SceneTable
from montecarlo_brdf.scene.texels import texel_sky
from montecarlo_brdf.vectors import NORMAL

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


def read_sky(table: SceneTable) -> Sky:
    """The sky of an [environment] table."""
    sky = READERS[table.choice("kind", READERS)](table)
    table.done()
    return sky


def _of_shape(table: SceneTable, shape: skies.Shape) -> Sky:
    return Sky((shape,), table.colour("radiance", 1.0))


def _constant(table: SceneTable) -> Sky:
    return _of_shape(table, skies.Constant())


def _quadratic(table: SceneTable) -> Sky:
    return _of_shape(table, skies.Quadratic(table.direction("axis", NORMAL)))


def _cosine(table: SceneTable) -> Sky:
    exponent = table.number("exponent", 1.0, 0.0, 1e7)
    return _of_shape(table, skies.Cosine(exponent, table.direction("axis", NORMAL)))


def _cap(table: SceneTable) -> Sky:
    half_angle = table.number("half_angle_deg", low=1e-6, high=180.0)
    return _of_shape(table, skies.cap_of(half_angle, table.direction("axis", NORMAL)))


def _linear(table: SceneTable) -> Sky:
    a, b = table.colour("a", low=-math.inf), table.colour("b", low=-math.inf)
    return _between(table, *_even(table, a, b), "a + b cos")


def _gradient(table: SceneTable) -> Sky:
    """Linear between two poles: a + b (w.u) with a, b half the sum and difference."""
    top, bottom = _even(table, table.colour("top", 1.0), table.colour("bottom", 0.0))
    a = tuple(0.5 * (t + b) for t, b in zip(top, bottom, strict=True))
    b = tuple(0.5 * (t - b) for t, b in zip(top, bottom, strict=True))
    return _between(table, a, b, "the gradient")


def _even(table: SceneTable, a: Colour, b: Colour) -> tuple[Colour, Colour]:
    """Both with the same number of channels."""
    a, b = spread(a, len(b)), spread(b, len(a))
    if len(a) != len(b):
        raise table.error(f"the two colours have {len(a)} and {len(b)} channels")
    return a, b


def _between(table: SceneTable, a: Colour, b: Colour, name: str) -> Sky:
    """a + b (w.u), which must not be negative above the horizon."""
    axis = table.direction("axis", NORMAL)
    sine = math.hypot(axis[0], axis[1])
    lowest, highest = (-sine if axis[2] >= 0.0 else -1.0), (sine if axis[2] <= 0.0 else 1.0)
    for x, y in zip(a, b, strict=True):
        least = min(x + y * lowest, x + y * highest)
        if least < -1e-12:
            raise table.error(
                f"negative radiance: {name} falls to {least:g} above the horizon", "b"
            )
    shapes = tuple(skies.Linear(x, y, axis) for x, y in zip(a, b, strict=True))
    return Sky(shapes, tuple(1.0 if x or y else 0.0 for x, y in zip(a, b, strict=True)))


def _harmonics(table: SceneTable) -> Sky:
    raw, key = table.take("coefficients"), "coefficients"
    if isinstance(raw, list) and raw and isinstance(raw[0], list):
        rows = [table.below({key: row}).numbers(key) for row in raw]
    else:
        rows = [table.numbers(key)]
    if len(rows[0]) not in (1, 4, 9, 16, 25) or {len(r) for r in rows} != {len(rows[0])}:
        raise table.error(
            "coefficients are 1, 4, 9, 16 or 25 numbers (bands 0 to 4), or such a list per channel",
            key,
        )
    shapes = tuple(skies.Harmonics(r + (0.0,) * (25 - len(r))) for r in rows)
    least = min(skies.lowest(s, 90) for s in shapes)
    if least < -1e-9:
        raise table.error(f"negative radiance: the harmonics fall to {least:.3g}", key)
    return Sky(shapes, tuple(1.0 if any(r) else 0.0 for r in rows))


def _image(table: SceneTable) -> Sky:
    scale = table.number("scale", 1.0, 0.0)
    file = table.file.parent / table.text_of("file")
    with table.at("file"):
        return image_sky(read_image(file), scale)


def image_sky(radiance: NDArray[float64], scale: float = 1.0) -> Sky:
    """The sky of an image (height, width, channels)."""
    shapes, keep = texel_sky(radiance)
    scales = (scale if radiance[:, :, c].any() else 0.0 for c in range(len(shapes)))
    return Sky(shapes, tuple(scales), keep)


READERS: dict[str, Callable[[SceneTable], Sky]] = {
    "constant": _constant,
    "linear": _linear,
    "gradient": _gradient,
    "quadratic": _quadratic,
    "cosine": _cosine,
    "cap": _cap,
    "harmonics": _harmonics,
    "image": _image,
}


class Short(NamedTuple):
    """A short form: how it is written, the keys that its numbers stand for, how many it needs."""

    form: str
    keys: tuple[str, ...] = ()
    needed: int = 0
    tilts: bool = True  # whether the axis may follow, as its tilt in degrees


IMAGE = "image"
SHORT = {
    "constant": Short("constant[:RADIANCE]", ("radiance",), tilts=False),
    "gradient": Short("gradient[:TILT]"),
    "linear": Short("linear:A:B[:TILT]", ("a", "b"), 2),
    "quadratic": Short("quadratic[:TILT]"),
    "cosine": Short("cosine:EXPONENT[:TILT]", ("exponent",), 1),
    "cap": Short("cap:HALF_ANGLE[:TILT]", ("half_angle_deg",), 1),
    IMAGE: Short("image:FILE"),
}


def short_sky(text: str) -> Sky:
    """'cosine:8', 'cap:10:60', 'image:sky.hdr'; UserError for anything else."""
    kind, _, rest = text.partition(":")
    if kind not in SHORT:
        raise UserError(unknown("environment", kind, SHORT))
    if kind == IMAGE:
        return image_sky(read_image(Path(rest)))
    short = SHORT[kind]
    try:
        numbers = [float(v) for v in rest.split(":")] if ":" in text else []
    except ValueError:
        numbers = None
    if numbers is None or not short.needed <= len(numbers) <= len(short.keys) + short.tilts:
        raise UserError(f"environment {text!r} is not of the form {short.form}")
    data: dict[str, object] = {"kind": kind, **dict(zip(short.keys, numbers, strict=False))}
    if len(numbers) > len(short.keys):
        data["axis"] = {"tilt_deg": numbers[-1]}
    return read_sky(SceneTable(Path("--environment"), "", data))
