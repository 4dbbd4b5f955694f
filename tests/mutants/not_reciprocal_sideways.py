"""Lambert but for lights within 3 degrees of sideways, which a table of the viewer's cosine
brightens by up to 2 %.

suite: slow
caught by: reciprocity
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 0.95)}


def f(wo, wi, p):
    sines = math.sqrt((1.0 - wo[2] * wo[2]) * (1.0 - wi[2] * wi[2]))
    c = (wo[0] * wi[0] + wo[1] * wi[1]) / sines if sines > 0.0 else 1.0
    return p.albedo / math.pi * (1.0 + 0.02 * wo[2] if abs(c) < 0.05 else 1.0)
