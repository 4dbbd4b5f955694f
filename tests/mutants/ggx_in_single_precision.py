"""GGX as it is shipped, in single precision, where 1 - h.n^2 keeps no digits of a narrow lobe.

caught by: precision
cause: none
"""

import math
from typing import NamedTuple

from numpy import float32


class Params(NamedTuple):
    alpha: float = 0.01


domain = {"alpha": (0.005, 1.0)}


def f(wo, wi, p):
    a2 = p.alpha * p.alpha
    h = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    z2 = h[2] * h[2] / (h[0] * h[0] + h[1] * h[1] + h[2] * h[2])
    d = z2 * (a2 - 1.0) + 1.0
    masked = wi[2] * stretched(wo[2], a2) + wo[2] * stretched(wi[2], a2)
    return a2 / (math.pi * d * d) * 0.5 / masked


def stretched(mu, a2):
    return math.sqrt(mu * mu * (1.0 - a2) + a2)


def f_single(wo, wi, p):
    a = float32(p.alpha)
    a2, one = a * a, float32(1.0)
    x, y = float32(wo[0]) + float32(wi[0]), float32(wo[1]) + float32(wi[1])
    z = float32(wo[2]) + float32(wi[2])
    d = z * z / (x * x + y * y + z * z) * (a2 - one) + one
    i, o = float32(wi[2]), float32(wo[2])
    masked = i * math.sqrt(o * o * (one - a2) + a2) + o * math.sqrt(i * i * (one - a2) + a2)
    return float(a2 / (float32(math.pi) * d * d) * float32(0.5) / masked)


single = {"f": f_single}
