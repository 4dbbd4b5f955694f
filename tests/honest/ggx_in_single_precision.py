"""GGX of a narrow lobe in single precision, in a form in which nothing cancels.

Why an honest one: single precision alone is no fault.
"""

import math
from typing import NamedTuple

from numpy import float32


class Params(NamedTuple):
    alpha: float = 0.01


domain = {"alpha": (0.005, 1.0)}


def f(wo, wi, p):
    a2 = p.alpha * p.alpha
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    q = (x * x + y * y + z * z) / (x * x + y * y + a2 * z * z)
    masked = wi[2] * stretched(wo, a2) + wo[2] * stretched(wi, a2)
    return a2 * q * q * 0.5 / (math.pi * masked)


def stretched(w, a2):
    return math.sqrt(w[2] * w[2] + a2 * (w[0] * w[0] + w[1] * w[1]))


def f_single(wo, wi, p):
    a = float32(p.alpha)
    ox, oy, oz = float32(wo[0]), float32(wo[1]), float32(wo[2])
    ix, iy, iz = float32(wi[0]), float32(wi[1]), float32(wi[2])
    x, y, z = ox + ix, oy + iy, oz + iz
    q = a * (x * x + y * y + z * z) / (x * x + y * y + a * a * z * z)
    so = math.sqrt(oz * oz + a * a * (ox * ox + oy * oy))
    si = math.sqrt(iz * iz + a * a * (ix * ix + iy * iy))
    return float(q * q * float32(0.5) / (float32(math.pi) * (iz * so + oz * si)))


single = {"f": f_single}
