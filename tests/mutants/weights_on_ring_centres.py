"""Lambert by twelve rings of equal flux; the jitter within a ring is forgotten and all its draws
have the polar angle of its middle. There is a weight, no pdf.

suite: slow
caught by: radiance
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}
RINGS = 12


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    k = math.floor(u[0] * RINGS)
    flux = (k + 0.5) / RINGS
    r, phi = math.sqrt(flux), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - flux), p.albedo
