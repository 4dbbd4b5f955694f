"""Anisotropic GGX with height-correlated masking, the width being that along each direction
(Heitz 2014), narrow along x and wide along y.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ax: float = 0.1
    ay: float = 0.8


domain = {"ax": (0.05, 1.0), "ay": (0.05, 1.0)}
isotropic = False


def d_over_4(wo, wi, ax, ay):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    s = 1.0 / (x * x + y * y + z * z)
    t = (x * x / (ax * ax) + y * y / (ay * ay) + z * z) * s
    return 1.0 / (4 * math.pi * ax * ay * t * t)


def stretched(w, ax, ay):
    return math.sqrt(ax * ax * w[0] * w[0] + ay * ay * w[1] * w[1] + w[2] * w[2])


def f(wo, wi, p):
    g = 2.0 / (wo[2] * stretched(wi, p.ax, p.ay) + wi[2] * stretched(wo, p.ax, p.ay))
    return d_over_4(wo, wi, p.ax, p.ay) * g
