"""Half-Lambert shading divided by the cosine to make it a BRDF.

caught by: reciprocity
cause: one direction
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    wrapped = (0.5 * wi[2] + 0.5) ** 2
    return 0.25 * p.albedo / math.pi * wrapped / wi[2]
