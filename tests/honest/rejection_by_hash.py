"""Rejection from the square; what is rejected draws again from numbers seeded by u[0]."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    x, y = 2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0
    s = int(u[0] * 4294967296.0) ^ int(u[1] * 4294967296.0)
    while x * x + y * y > 1.0:
        s = (1664525 * s + 1013904223) % 4294967296
        x = s / 2147483648.0 - 1.0
        s = (1664525 * s + 1013904223) % 4294967296
        y = s / 2147483648.0 - 1.0
    return x, y, math.sqrt(max(0.0, 1.0 - x * x - y * y))


def pdf(wo, wi, p):
    return wi[2] / math.pi
