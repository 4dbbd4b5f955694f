"""Lommel-Seeliger; the viewer exactly at the normal has a formula of its own, not so the light.

suite: slow
caught by: reciprocity
cause: normal incidence
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.5


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    if wo[2] == 1.0:
        return p.albedo / (2.0 * math.pi)
    return p.albedo / (2.0 * math.pi) / (wo[2] + wi[2])
