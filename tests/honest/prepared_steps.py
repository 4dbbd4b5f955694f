"""A cosine power drawn by a table of 48 steps that prepare() makes: the pdf is the table's, a
staircase, and not that of the power.

suite: slow
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


domain = {"albedo": (0.0, 1.0), "m": (0.0, 12.0)}
ROWS = 48


def prepare(p):
    sums = tuple(1.0 - (1.0 - k / ROWS) ** (p.m + 1.0) for k in range(ROWS + 1))
    return Table(p.albedo, p.m, sums)


def f(wo, wi, p):
    return p.albedo * (p.m + 2.0) / (2.0 * math.pi) * (wo[2] * wi[2]) ** p.m


def sample(wo, u, p):
    k = 0
    while k < ROWS - 1 and p.sums[k + 1] <= u[0]:
        k += 1
    z = 1.0 - (k + (u[0] - p.sums[k]) / (p.sums[k + 1] - p.sums[k])) / ROWS
    s, phi = math.sqrt(max(0.0, 1.0 - z * z)), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), z


def pdf(wo, wi, p):
    k = min(ROWS - 1, int((1.0 - wi[2]) * ROWS))
    return (p.sums[k + 1] - p.sums[k]) * ROWS / (2.0 * math.pi)
