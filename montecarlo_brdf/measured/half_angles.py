"""A measured isotropic BRDF, as a table over half and difference angles.

f = T[theta_h, theta_d, phi_d]  [1/sr], 90 x 90 x 180 values for each of three channels

Sampling: half vectors from the table's mean over theta_d and phi_d, linear between bins, reflected;
a tenth cosine-weighted.
channel: 0 red, 1 green, 2 blue.
interpolate: nearest (the bin that holds the angles, which is how the data are defined) or linear
(between the centres of bins, leaving out neighbours that were not measured).
scale: merl (1/1500, 1.15/1500, 1.66/1500 for the channels) or one, for files that hold 1/sr.
Source: Matusik, Pfister, Brand & McMillan 2003, "A data-driven reflectance model"; Rusinkiewicz
1998, "A new change of variables for efficient BRDF representation".
What was not measured (negative values) reflects nothing. phi_d is stored modulo 180 degrees, so
that f is reciprocal. Measured data may gain energy at grazing angles.
"""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.bits import double_at
from montecarlo_brdf.errors import ModelError
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine
from montecarlo_brdf.vectors import Vec

HALVES, DIFFERENCES, TURNS = 90, 90, 180  # bins of theta_h, theta_d, phi_d
QUARTER = 0.5 * math.pi
COSINE = 0.1  # of the draws


class Params(NamedTuple):
    channel: Any = (0.0, 1.0, 2.0)


class Table(NamedTuple):
    """Where a channel lies in memory; the numbers travel with others, the tables do not."""

    values: float  # address of T in file order, scaled
    shares: float  # address of the share of half vectors before the edges of theta_h's bins
    heights: float  # address of their density in sin^2(theta_h) at the edges, linear between them


#: per scale and channel a Table or a sentence that says why it is none; set by whoever reads a file
TABLES: Sequence[Sequence[Any]] = ()


def nearest(x: float, y: float, z: float, values: float) -> float:
    """The bin that holds the place."""
    i, j, k = min(int(x), HALVES - 1), min(int(y), DIFFERENCES - 1), min(int(z), TURNS - 1)
    return max(0.0, double_at(values, (i * DIFFERENCES + j) * TURNS + k))


def linear(x: float, y: float, z: float, values: float) -> float:
    """Between centres; what was not measured counts for nothing, also in the weights."""
    i, j, k = math.floor(x - 0.5), math.floor(y - 0.5), math.floor(z - 0.5)
    u, v, w = x - 0.5 - i, y - 0.5 - j, z - 0.5 - k
    total, weights = 0.0, 0.0
    for a in range(2):
        row = min(max(int(i) + a, 0), HALVES - 1) * DIFFERENCES
        for b in range(2):
            first = (row + min(max(int(j) + b, 0), DIFFERENCES - 1)) * TURNS
            for c in range(2):
                turn = (int(k) + c + TURNS) % TURNS
                value = double_at(values, first + turn)
                weight = (u if a == 1 else 1.0 - u) * (v if b == 1 else 1.0 - v)
                weight = weight * (w if c == 1 else 1.0 - w)
                known = value >= 0.0
                total += weight * value if known else 0.0
                weights += weight if known else 0.0
    return total / weights if weights > 0.0 else 0.0


def merl() -> int:
    """The scales of the database."""
    return 0


def one() -> int:
    """Values in 1/sr."""
    return 1


choices = {"interpolate": {"nearest": nearest, "linear": linear},
           "scale": {"merl": merl, "one": one}}  # fmt: skip
interpolate, scale = nearest, merl


def prepare(p: Params) -> Table:
    """The addresses of the channel."""
    if p.channel not in (0.0, 1.0, 2.0):
        raise ModelError(f"channel must be 0, 1 or 2, not {p.channel:g}")
    found = TABLES[scale()][int(p.channel)]
    if isinstance(found, str):
        raise ModelError(found)
    return Table(*found)


def f(wo: Vec, wi: Vec, p: Table) -> float:
    """The table at the half and difference angles."""
    hx, hy, hz = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    dx, dy, dz = wi[0] - wo[0], wi[1] - wo[1], wi[2] - wo[2]
    side = math.sqrt(hx * hx + hy * hy)
    sum_length = math.sqrt(hx * hx + hy * hy + hz * hz)
    difference = math.sqrt(dx * dx + dy * dy + dz * dz)
    c, s = (hx / side, hy / side) if side > 0.0 else (1.0, 0.0)
    # along theta_h and across it; exchanging wo and wi turns both signs, and phi_d by 180 degrees
    along = (hz * (c * dx + s * dy) - side * dz) / sum_length
    across = c * dy - s * dx
    sign = -1.0 if across < 0.0 or (across == 0.0 and along < 0.0) else 1.0
    phi = math.atan2(sign * across, sign * along)
    x = HALVES * math.sqrt(math.atan2(side, hz) / QUARTER)
    y = DIFFERENCES * math.atan2(difference, sum_length) / QUARTER
    return interpolate(x, y, TURNS * phi / math.pi, p.values)


def edge(k: float) -> float:
    """sin^2 of theta_h where bin k begins."""
    t = k / HALVES
    s = math.sin(t * t * QUARTER)
    return s * s


def sample(wo: Vec, u: Vec, p: Table) -> Vec:
    """Reflection by a half vector; or cosine-weighted."""
    if u[2] < COSINE:
        return random_hemisphere_cosine(u[0], u[1])
    low, high = 0, HALVES - 1
    while low < high:
        middle = (low + high) // 2
        if double_at(p.shares, middle + 1) > u[0]:
            high = middle
        else:
            low = middle + 1
    first, rest = edge(low * 1.0), u[0] - double_at(p.shares, low)
    height, slope = line(low, p)
    square = first + 2.0 * rest / (height + math.sqrt(height * height + 2.0 * rest * slope))
    square = min(max(square, 0.0), 1.0)
    s, z, phi = math.sqrt(square), math.sqrt(1.0 - square), 2.0 * math.pi * u[1]
    hx, hy = s * math.cos(phi), s * math.sin(phi)
    twice = 2.0 * (hx * wo[0] + hy * wo[1] + z * wo[2])
    return twice * hx - wo[0], twice * hy - wo[1], twice * z - wo[2]


def line(k: int, p: Table) -> tuple[float, float]:
    """The density in sin^2(theta_h) where bin k begins, and how it grows."""
    low, high = double_at(p.heights, k), double_at(p.heights, k + 1)
    return low, (high - low) / (edge(k + 1.0) - edge(k * 1.0))


def pdf(wo: Vec, wi: Vec, p: Table) -> float:
    """The density of the mixture: of half vectors p_h = cos(theta_h)/pi that in sin^2(theta_h),
    divided by 4 wo.h."""
    hx, hy, hz = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    side = hx * hx + hy * hy
    length = math.sqrt(side + hz * hz)
    theta = math.atan2(math.sqrt(side), hz)
    k = min(int(HALVES * math.sqrt(theta / QUARTER)), HALVES - 1)
    height, slope = line(k, p)
    density = height + slope * (side / (length * length) - edge(k * 1.0))
    halves = max(density, 0.0) * hz / (math.pi * length)
    return (1.0 - COSINE) * halves / (2.0 * length) + COSINE * wi[2] / math.pi
