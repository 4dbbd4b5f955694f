"""The diffuse part is attenuated by what the coat lets in, not by what it lets out.

caught by: reciprocity
cause: one direction
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    entering = 1.0 - 0.04 - 0.96 * (1.0 - wi[2]) ** 5
    return entering * p.albedo / math.pi
