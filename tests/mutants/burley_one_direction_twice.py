"""Burley's diffuse with the light's cosine in both factors.

caught by: reciprocity
cause: one direction
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    c = 1.0 - wi[2]
    return p.albedo / math.pi * (1.0 - 0.4 * c**5) * (1.0 - 0.4 * c**5)
