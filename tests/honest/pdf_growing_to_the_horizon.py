"""Lommel-Seeliger drawn by cos = u^2: the pdf grows like cos^-1/2 to the horizon.

suite: slow
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    w: float = 1.0


domain = {"w": (0.0, 1.0)}


def f(wo, wi, p):
    return p.w / (4.0 * math.pi * (wo[2] + wi[2]))


def sample(wo, u, p):
    z = (1.0 - u[0]) * (1.0 - u[0])
    s, phi = math.sqrt(1.0 - z * z), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), z


def pdf(wo, wi, p):
    return 1.0 / (4.0 * math.pi * math.sqrt(wi[2]))


def albedo(cos_theta_o, p):
    return 0.5 * p.w * (1.0 - cos_theta_o * math.log1p(1.0 / cos_theta_o))
