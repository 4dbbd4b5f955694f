"""Points outside the disk are rejected, the pdf knows nothing of it.

caught by: pdf
cause: horizon
"""

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
    return x, y, math.sqrt(max(0.0, 1.0 - x * x - y * y))


def pdf(wo, wi, p):
    return wi[2] / math.pi
