"""A spot of 0.8 degrees, for viewers and lights alike, reflects more than it receives.

caught by: energy
cause: angle
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.9


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    a = math.exp((wo[0] * 0.3 + wo[1] * 0.4 + wo[2] * 0.8660254037844386 - 1.0) / 1e-4)
    b = math.exp((wi[0] * 0.3 + wi[1] * 0.4 + wi[2] * 0.8660254037844386 - 1.0) / 1e-4)
    return p.albedo / math.pi * (1.0 + a + b)


isotropic = False
