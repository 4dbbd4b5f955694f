"""The azimuth plane is normalised from wo x wi: 0/0 at wi = wo.

caught by: positivity
cause: wi = wo
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    x = wo[1] * wi[2] - wo[2] * wi[1]
    y = wo[2] * wi[0] - wo[0] * wi[2]
    z = wo[0] * wi[1] - wo[1] * wi[0]
    length = math.sqrt(x * x + y * y + z * z)
    return p.albedo / math.pi * (1.0 - 0.1 * (z / length) ** 2)
