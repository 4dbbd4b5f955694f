"""Fresnel scaled by its value at the normal: 0/0 where the index of refraction is 1.

caught by: positivity
cause: range end
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    eta: float = 1.5


domain = {"eta": (1.0, 3.0)}


def f(wo, wi, p):
    f0 = ((p.eta - 1.0) / (p.eta + 1.0)) ** 2
    schlick = f0 + (1.0 - f0) * (1.0 - wo[2]) ** 5 * (1.0 - wi[2]) ** 5
    return 0.1 * (schlick - f0) / f0 * f0 / math.pi
