"""Four kinds of diffuse surfaces in one file, picked by a number; the third lacks its 1/pi.

suite: slow
caught by: energy
cause: factor 1/pi missing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    kind: float = 0.0


domain = {"albedo": (0.0, 1.0), "kind": (0.0, 3.0)}


def f(wo, wi, p):
    if p.kind == 1.0:  # Lommel-Seeliger
        return p.albedo / (2.0 * math.pi) / (wo[2] + wi[2])
    if p.kind == 2.0:  # Minnaert, exponent 2
        return p.albedo * 1.5 * wo[2] * wi[2]
    if p.kind == 3.0:  # both
        return p.albedo * 0.5 * (0.5 / (wo[2] + wi[2]) + 1.0) / math.pi
    return p.albedo / math.pi
