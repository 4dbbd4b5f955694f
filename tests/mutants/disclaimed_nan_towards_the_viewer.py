"""Not a number towards the viewer, where a cosine rounds beyond 1, behind a disclaimer that f may
be negative.

caught by: positivity
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}
disclaims = {"positivity": "a regression basis: negative towards grazing"}


def f(wo, wi, p):
    c = wo[0] * wi[0] + wo[1] * wi[1] + wo[2] * wi[2]
    return p.albedo / math.pi * (1.0 + 0.0 * math.acos(c))
