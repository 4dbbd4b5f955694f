"""A factor 2 too much: normalised over the hemisphere of 2 pi sr, albedo/2 forgotten.

caught by: energy
cause: factor 2
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return 2.0 * p.albedo / math.pi
