"""Matte surface of four kinds, chosen by a whole number: one of them gains.

suite: slow
caught by: energy
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    kind: float = 0.0


domain = {"albedo": (0.0, 1.0), "kind": (0.0, 3.0)}


def dusty(wo, wi):
    return 0.5 / (wo[2] + wi[2])


def velvet(wo, wi):
    return 3.0 * (1.0 - wo[2]) * (1.0 - wi[2])


def f(wo, wi, p):
    if p.kind == 1.0:
        return p.albedo / math.pi * dusty(wo, wi)
    if p.kind == 2.0:
        return p.albedo * velvet(wo, wi)
    if p.kind == 3.0:
        return p.albedo / math.pi * (0.5 + 0.5 * dusty(wo, wi))
    return p.albedo / math.pi
