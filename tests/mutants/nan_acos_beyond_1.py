"""acos of a cosine that rounds beyond 1 where directions are collinear.

caught by: positivity
cause: wi = wo
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    phase = math.acos(wo[0] * wi[0] + wo[1] * wi[1] + wo[2] * wi[2])
    return p.albedo / math.pi * (1.0 - 0.3 * phase / math.pi)
