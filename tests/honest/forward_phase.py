"""A Henyey-Greenstein lobe around the mirror direction, g up to 0.95."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    g: float = 0.9


domain = {"g": (0.0, 0.95)}


def f(wo, wi, p):
    c = wo[2] * wi[2] - wo[0] * wi[0] - wo[1] * wi[1]
    k = (1.0 - p.g) ** 2 + 2.0 * p.g * (1.0 - c)
    return 0.25 / math.pi * (1.0 - p.g * p.g) / (k * math.sqrt(k))
