"""Reflects too much only for viewers at azimuth 90 degrees.

caught by: energy
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}
isotropic = False


def f(wo, wi, p):
    return 0.98 * p.albedo / math.pi * (1.0 + 0.1 * (wo[1] ** 4 + wi[1] ** 4))
