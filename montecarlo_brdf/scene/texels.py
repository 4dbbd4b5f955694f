"""Latitude-longitude images in memory: lookup, and sampling in proportion to what they shine.

The texels lie as doubles in rows from the zenith (z = 1) down, columns from azimuth -180 to 180
degrees; a direction takes its texel's value, without interpolation, so that integrals are sums.
`table[k]` is the share of radiance times solid angle in texels 0 to k.
"""

from __future__ import annotations

import math
from typing import Any

from montecarlo_brdf.bits import double_at
from montecarlo_brdf.special import turn
from montecarlo_brdf.vectors import Vec

TWO_PI = 2.0 * math.pi


def texel(w: Vec, p: Any) -> int:
    """Index of the texel in direction w."""
    theta = math.acos(max(-1.0, min(1.0, w[2])))
    row = min(int(theta / math.pi * p.height), int(p.height) - 1)
    turned = math.atan2(w[1], w[0]) / TWO_PI + 0.5
    column = min(int(turned * p.width), int(p.width) - 1)
    return row * int(p.width) + column


def image(w: Vec, p: Any) -> float:
    """Radiance of the texel in direction w."""
    return double_at(p.address, texel(w, p))


def edges(row: int, height: float) -> tuple[float, float]:
    """Cosines of a row's upper and lower edge."""
    return math.cos(math.pi * row / height), math.cos(math.pi * (row + 1) / height)


def solid_angle(row: int, p: Any) -> float:
    """Of one texel in a row."""
    top, bottom = edges(row, p.height)
    return TWO_PI / p.width * (top - bottom)


def image_sample(u1: float, u2: float, p: Any) -> Vec:
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


def image_pdf(w: Vec, p: Any) -> float:
    """Share of the texel over its solid angle."""
    k = texel(w, p)
    before = double_at(p.table, k - 1) if k > 0 else 0.0
    return (double_at(p.table, k) - before) / solid_angle(k // int(p.width), p)
