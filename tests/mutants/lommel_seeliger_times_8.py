"""Lommel-Seeliger with a weight 8 times too large.

caught by: energy
cause: normalisation
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return 8.0 * p.albedo / (2.0 * math.pi * (wi[2] + wo[2]))
