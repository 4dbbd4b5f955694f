"""Azimuths are normalised: 0/0 at normal incidence.

caught by: positivity
cause: normal incidence
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    ro = math.sqrt(wo[0] * wo[0] + wo[1] * wo[1])
    ri = math.sqrt(wi[0] * wi[0] + wi[1] * wi[1])
    c = (wo[0] * wi[0] + wo[1] * wi[1]) / (ro * ri)
    return p.albedo / math.pi * (0.9 + 0.1 * c * ro * ri)
