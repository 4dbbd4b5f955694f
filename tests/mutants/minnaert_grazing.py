"""Minnaert's exponent below 1 without its normalisation: more than 1 at grazing angles.

caught by: energy
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    k: float = 0.5


domain = {"albedo": (0.0, 1.0), "k": (0.5, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi * (wi[2] * wo[2]) ** (p.k - 1.0)
