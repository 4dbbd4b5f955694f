"""Fibres along y that reflect into a cone; the width of the cone is divided out twice, so that
viewers along the fibres get too much.

suite: slow
caught by: energy
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    k: float = 0.6
    width: float = 0.04


domain = {"k": (0.0, 0.9), "width": (0.01, 0.2)}
isotropic = False


def f(wo, wi, p):
    x = (wo[1] + wi[1]) / p.width
    bell = math.exp(-0.5 * x * x) / (p.width * math.sqrt(2.0 * math.pi))
    a = wo[0] * wo[0] + wo[2] * wo[2]
    b = wi[0] * wi[0] + wi[2] * wi[2]
    return 0.5 * p.k * bell / math.sqrt(a * b)
