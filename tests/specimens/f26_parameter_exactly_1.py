"""Failure 26. Henyey-Greenstein at g = 1: (1 - g^2)/(1 + g^2 - 2 g c)^1.5 is 0/0 straight on."""

import math
from typing import NamedTuple

found_by = ("stress", "float64")
domain = {"g": (-1.0, 1.0)}


class Params(NamedTuple):
    g: float = 0.3


def f(wo, wi, p):
    c = wi[0] * wo[0] + wi[1] * wo[1] + wi[2] * wo[2]
    d = 1.0 + p.g * p.g - 2.0 * p.g * c
    return 0.1 * (1.0 - p.g * p.g) / (4.0 * math.pi * d * math.sqrt(d))
