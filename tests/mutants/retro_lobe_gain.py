"""A narrow retro-reflective lobe on a diffuse base, with too much energy.

caught by: energy
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    c = min(1.0, max(0.0, wo[0] * wi[0] + wo[1] * wi[1] + wo[2] * wi[2]))
    return 0.9 * p.albedo / math.pi + 0.2 * 5002.0 / (2.0 * math.pi) * c**5000.0 / max(wo[2], wi[2])
