"""Not a number 0.057 degrees above the horizon, behind a disclaimer that f may be negative.

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
    low = wo[2] if wo[2] < wi[2] else wi[2]
    return p.albedo / math.pi * (1.0 + 0.0 * math.sqrt(low - 0.001))
