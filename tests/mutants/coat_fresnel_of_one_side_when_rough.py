"""A coat whose Fresnel is that of the viewer where roughness exceeds 0.7 and the viewer grazes,
as an approximation, and that of both directions elsewhere.

suite: slow
caught by: reciprocity
cause: grazing
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.6
    rough: float = 0.3


domain = {"base": (0.0, 0.6), "rough": (0.0, 1.0)}


def f(wo, wi, p):
    both = (1.0 - 0.3 * (1.0 - wo[2]) ** 5) * (1.0 - 0.3 * (1.0 - wi[2]) ** 5)
    one = (1.0 - 0.3 * (1.0 - wo[2]) ** 5) ** 2
    k = one if p.rough > 0.7 and wo[2] < 0.2 else both
    return p.base / math.pi * k
