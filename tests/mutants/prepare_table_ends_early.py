"""A lobe of the polar angle drawn by a table of prepare(); the table stops at 60 degrees for
exponents below 1.5, where it was never looked at.

suite: slow
caught by: cover
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.7
    m: float = 4.0


class Table(NamedTuple):
    albedo: float
    m: float
    sums: tuple


domain = {"albedo": (0.0, 1.0), "m": (0.5, 12.0)}
ROWS = 48


def prepare(p):
    sums = []
    for k in range(ROWS + 1):
        z = 1.0 - k / ROWS
        if p.m < 1.5:
            z = max(z, 0.5)
        sums.append(1.0 - z ** (p.m + 1.0))
    return Table(p.albedo, p.m, tuple(sums))


def f(wo, wi, p):
    return p.albedo * (p.m + 2.0) / (2.0 * math.pi) * (wo[2] * wi[2]) ** p.m


def sample(wo, u, p):
    k = 0
    while k < ROWS - 1 and p.sums[k + 1] <= u[0]:
        k += 1
    low, high = p.sums[k], max(p.sums[k + 1], p.sums[k] + 1e-12)
    z = max(0.0, 1.0 - (k + min(1.0, (u[0] - low) / (high - low))) / ROWS)
    s, phi = math.sqrt(1.0 - z * z), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), z


def pdf(wo, wi, p):
    k = min(ROWS - 1, int((1.0 - wi[2]) * ROWS))
    a, b = 1.0 - k / ROWS, 1.0 - (k + 1) / ROWS
    return (a ** (p.m + 1.0) - b ** (p.m + 1.0)) * ROWS / (2.0 * math.pi)
