"""Latitude-longitude images as skies: lookup, and sampling in proportion to what they shine.

The texels lie as doubles in rows from the zenith (z = 1) down, columns from azimuth -180 to 180
degrees; a direction takes its texel's value, without interpolation, so that integrals are sums.
"""

from __future__ import annotations

import hashlib
import math
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.bits import double_at
from montecarlo_brdf.special import turn
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

TWO_PI = 2.0 * math.pi


class Image(NamedTuple):
    """Texels of one channel; doubles, because they travel through kernels with other numbers."""

    address: float = 0.0  # of the radiances in memory
    table: float = 0.0  # address of the shares of radiance times solid angle in texels 0 to k
    width: float = 0.0
    height: float = 0.0
    content: float = 0.0  # a hash: what the image shows, wherever it lies


def texel_sky(radiance: NDArray[float64]) -> tuple[tuple[Image, ...], list[NDArray[float64]]]:
    """The shapes of an image (height, width, channels), one per channel.

    Beside them the arrays that must stay alive while they are used: radiance and table of each.
    """
    import numpy as np

    height, width, count = radiance.shape
    shapes: list[Image] = []
    keep: list[NDArray[float64]] = []
    for channel in range(count):
        plane = np.ascontiguousarray(radiance[:, :, channel])
        table = cumulated(plane)
        keep += [plane, table]
        addresses = (float(plane.ctypes.data), float(table.ctypes.data))
        digest = hashlib.blake2b(plane.tobytes(), digest_size=6).digest()
        content = float(int.from_bytes(digest, "little"))
        shapes.append(Image(*addresses, float(width), float(height), content))
    return tuple(shapes), keep


def cumulated(plane: NDArray[float64], below: bool = False) -> NDArray[float64]:
    """Shares (height * width) of radiance times solid angle in texels 0 to k of a plane.

    below: also under the horizon, which no flat surface sees.
    """
    import numpy as np

    height = len(plane)
    edges = np.cos(np.linspace(0.0, np.pi, height + 1))
    share = np.maximum(edges[:-1] - edges[1:], 0.0)[:, None]
    if not below:
        share[np.arange(height) * np.pi / height >= np.pi / 2] = 0.0
    table = np.cumsum((plane * share).ravel())
    return table / table[-1] if table[-1] > 0.0 else np.linspace(0.0, 1.0, len(table))


def texel(w: Vec, p: Image) -> int:
    """Index of the texel in direction w."""
    theta = math.acos(max(-1.0, min(1.0, w[2])))
    row = min(int(theta / math.pi * p.height), int(p.height) - 1)
    turned = math.atan2(w[1], w[0]) / TWO_PI + 0.5
    column = min(int(turned * p.width), int(p.width) - 1)
    return row * int(p.width) + column


def image(w: Vec, p: Image) -> float:
    """Radiance of the texel in direction w."""
    return double_at(p.address, texel(w, p))


def edges(row: int, height: float) -> tuple[float, float]:
    """Cosines of a row's upper and lower edge."""
    return math.cos(math.pi * row / height), math.cos(math.pi * (row + 1) / height)


def solid_angle(row: int, p: Image) -> float:
    """Of one texel in a row."""
    top, bottom = edges(row, p.height)
    return TWO_PI / p.width * (top - bottom)


def image_sample(u1: float, u2: float, p: Image) -> Vec:
    """A texel by its share, by bisection, then uniform in its solid angle; u1 is used again."""
    low, high = 0, int(p.width * p.height) - 1
    while low < high:
        middle = (low + high) // 2
        if double_at(p.table, middle) > u1:
            high = middle
        else:
            low = middle + 1
    before = double_at(p.table, low - 1) if low > 0 else 0.0
    rest = (u1 - before) / (double_at(p.table, low) - before)
    row, column = low // int(p.width), low % int(p.width)
    top, bottom = edges(row, p.height)
    z = top + rest * (bottom - top)
    c, s = turn((column + u2) / p.width)
    r = math.sqrt(max(0.0, 1.0 - z * z))
    return r * c, r * s, z


def image_pdf(w: Vec, p: Image) -> float:
    """Share of the texel over its solid angle."""
    k = texel(w, p)
    before = double_at(p.table, k - 1) if k > 0 else 0.0
    return (double_at(p.table, k) - before) / solid_angle(k // int(p.width), p)
