"""The azimuth counts only near the end of a parameter that the defaults leave at 0.

caught by: isotropy
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5
    brushed: float = 0.0


domain = {"albedo": (0.0, 1.0), "brushed": (0.0, 1.0)}


def f(wo, wi, p):
    k = max(0.0, p.brushed - 0.8)
    return p.albedo / math.pi * (1.0 - k * (wo[0] * wo[0] + wi[0] * wi[0]))
