"""The cosine of the azimuths is not clamped at 0.

caught by: equality
cause: azimuth
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8
    sigma: float = 0.35


domain = {"albedo": (0.0, 0.9), "sigma": (0.0, 1.5)}
same_as = "oren_nayar"


def f(wo, wi, p):
    s2 = p.sigma * p.sigma
    a = 1.0 - 0.5 * s2 / (s2 + 0.33)
    b = 0.45 * s2 / (s2 + 0.09)
    theta_o = math.acos(min(1.0, wo[2]))
    theta_i = math.acos(min(1.0, wi[2]))
    alpha = max(theta_o, theta_i)
    beta = min(theta_o, theta_i)
    phi = math.atan2(wo[1], wo[0]) - math.atan2(wi[1], wi[0])
    c = math.cos(phi)
    return p.albedo / math.pi * (a + b * c * math.sin(alpha) * math.tan(beta))
