"""An opposition surge by a logarithm, which may turn negative elsewhere and says so; it is infinite
where light and viewer coincide.

suite: slow
caught by: positivity
cause: wi = wo
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5
    surge: float = 0.1


domain = {"albedo": (0.0, 0.6), "surge": (0.0, 0.1)}
disclaims = {"positivity": "a fit of phase angles up to 90 degrees"}


def f(wo, wi, p):
    x, y, z = wo[0] - wi[0], wo[1] - wi[1], wo[2] - wi[2]
    apart = x * x + y * y + z * z
    return p.albedo / math.pi * (0.2 - p.surge * math.log(apart))
