"""Shirley and Chiu's concentric map of the square to the disk, lifted."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    x = 2.0 * u[0] - 1.0
    y = 2.0 * u[1] - 1.0
    if abs(x) > abs(y):
        r = x
        phi = 0.25 * math.pi * y / x
    elif y != 0.0:
        r = y
        phi = 0.5 * math.pi - 0.25 * math.pi * x / y
    else:
        r = 0.0
        phi = 0.0
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(max(0.0, 1.0 - r * r))


def pdf(wo, wi, p):
    return wi[2] / math.pi
