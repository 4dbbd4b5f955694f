"""[environment] tables, and the short form on the command line, as skies."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.scene import skies
from montecarlo_brdf.scene.image import Texels, read_image
from montecarlo_brdf.scene.image_sky import texel_sky
from montecarlo_brdf.scene.skies import Sky
from montecarlo_brdf.scene.toml import Table
from montecarlo_brdf.vectors import NORMAL, Vec

KINDS = ("constant", "linear", "gradient", "quadratic", "cosine", "cap", "harmonics", "image")
Colour = float | tuple[float, ...]


class RawSky(NamedTuple):
    """A sky before the number of channels is known."""

    shapes: tuple[Any, ...]
    scales: tuple[float, ...]
    keep: Any = None

    @property
    def channels(self) -> int:
        """How many channels it has itself."""
        return max(len(self.shapes), len(self.scales))

    def spread(self, count: int) -> Sky:
        """The sky in `count` channels."""
        shapes = self.shapes * count if len(self.shapes) == 1 else self.shapes
        scales = self.scales * count if len(self.scales) == 1 else self.scales
        return Sky(shapes, scales, self.keep)


def read_sky(table: Table) -> RawSky:
    """The sky of an [environment] table."""
    kind = table.choice("kind", KINDS)
    sky = _READERS[kind](table)
    table.done()
    return sky


def _row(value: Colour) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)


def _constant(table: Table) -> RawSky:
    return RawSky((skies.Constant(),), _row(table.colour("radiance", 1.0)))


def _linear(table: Table) -> RawSky:
    a, b = _row(table.colour("a", low=-math.inf)), _row(table.colour("b", low=-math.inf))
    return _two(table, a, b, "a + b cos")


def _gradient(table: Table) -> RawSky:
    """Linear between two poles: a + b (w.u) with a, b half the sum and difference."""
    top, bottom = _row(table.colour("top", 1.0)), _row(table.colour("bottom", 0.0))
    top, bottom = _even(table, top, bottom)
    a = tuple(0.5 * (t + b) for t, b in zip(top, bottom, strict=True))
    b = tuple(0.5 * (t - b) for t, b in zip(top, bottom, strict=True))
    return _two(table, a, b, "the gradient")


def _even(table: Table, a: tuple[float, ...], b: tuple[float, ...]) -> tuple[Any, Any]:
    count = max(len(a), len(b))
    a, b = (v * count if len(v) == 1 else v for v in (a, b))
    if len(a) != len(b):
        raise table.error(f"the two colours have {len(a)} and {len(b)} channels")
    return a, b


def _two(table: Table, a: Any, b: Any, name: str) -> RawSky:
    axis = table.direction("axis", NORMAL)
    a, b = _even(table, a, b)
    sine = math.hypot(axis[0], axis[1])
    lowest, highest = (-sine if axis[2] >= 0.0 else -1.0), (sine if axis[2] <= 0.0 else 1.0)
    for one, two in zip(a, b, strict=True):
        least = min(one + two * lowest, one + two * highest)
        if least < -1e-12:
            raise table.error(
                f"negative radiance: {name} falls to {least:g} above the horizon", "b"
            )
    shapes = tuple(skies.Linear(x, y, axis) for x, y in zip(a, b, strict=True))
    scales = tuple(1.0 if x or y else 0.0 for x, y in zip(a, b, strict=True))
    return RawSky(shapes, scales)


def _quadratic(table: Table) -> RawSky:
    return RawSky(
        (skies.Quadratic(table.direction("axis", NORMAL)),), _row(table.colour("radiance", 1.0))
    )


def _cosine(table: Table) -> RawSky:
    shape = skies.Cosine(table.number("exponent", 1.0, 0.0, 1e7), table.direction("axis", NORMAL))
    return RawSky((shape,), _row(table.colour("radiance", 1.0)))


def cap_of(half_angle_deg: float, axis: Vec) -> skies.Cap:
    """A cap by its half angle: depth = 2 sin^2(angle/2)."""
    return skies.Cap(2.0 * math.sin(math.radians(half_angle_deg) / 2.0) ** 2, axis)


def _cap(table: Table) -> RawSky:
    shape = cap_of(
        table.number("half_angle_deg", low=1e-6, high=180.0), table.direction("axis", NORMAL)
    )
    return RawSky((shape,), _row(table.colour("radiance", 1.0)))


def _harmonics(table: Table) -> RawSky:
    raw = table.take("coefficients")
    nested = isinstance(raw, list) and bool(raw) and isinstance(raw[0], list)
    rows = (
        [
            Table(table.file, table.text, {"coefficients": r}, table.path).numbers("coefficients")
            for r in raw
        ]
        if nested
        else [table.numbers("coefficients")]
    )
    if len(rows[0]) not in (1, 4, 9, 16, 25) or {len(r) for r in rows} != {len(rows[0])}:
        raise table.error(
            "coefficients are 1, 4, 9, 16 or 25 numbers (bands 0 to 4), or such a list per channel",
            "coefficients",
        )
    shapes = tuple(skies.Harmonics(r + (0.0,) * (25 - len(r))) for r in rows)
    least = min(skies.lowest(s, 90) for s in shapes)
    if least < -1e-9:
        raise table.error(f"negative radiance: the harmonics fall to {least:.3g}", "coefficients")
    return RawSky(shapes, tuple(1.0 if any(r) else 0.0 for r in rows))


def _image(table: Table) -> RawSky:
    scale = table.number("scale", 1.0, 0.0)
    file = table.file.parent / table.text_of("file")
    try:
        return raw_image(read_image(file), scale)
    except UserError as error:
        raise table.error(str(error), "file") from error


def raw_image(texels: Texels, scale: float) -> RawSky:
    """The sky of an image."""
    shapes, keep = texel_sky(texels)
    return RawSky(shapes, tuple(scale if any(row) else 0.0 for row in texels.sums), keep)


_READERS = {
    "constant": _constant,
    "linear": _linear,
    "gradient": _gradient,
    "quadratic": _quadratic,
    "cosine": _cosine,
    "cap": _cap,
    "harmonics": _harmonics,
    "image": _image,
}
