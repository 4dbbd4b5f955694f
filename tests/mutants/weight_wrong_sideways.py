"""A weight without a pdf that is 30 % wrong left and right, as if light from y came from -y.

caught by: radiance
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    y = r * math.sin(phi)
    return r * math.cos(phi), y, math.sqrt(1.0 - u[0]), p.albedo * (1.0 + 0.3 * y)
