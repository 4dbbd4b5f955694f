"""Failure 19. Anisotropic GGX whose domain includes alpha_x = 0: h_x/alpha_x is 0/0."""

import math
from typing import NamedTuple

found_by = ("stress", "float64")
isotropic = False
domain = {"alpha_x": (0.0, 1.0), "alpha_y": (0.0, 1.0)}


class Params(NamedTuple):
    alpha_x: float = 0.2
    alpha_y: float = 0.4


def f(wo, wi, p):
    x, y, z = (wi[0] + wo[0]) / p.alpha_x, (wi[1] + wo[1]) / p.alpha_y, wi[2] + wo[2]
    l2 = (wi[0] + wo[0]) ** 2 + (wi[1] + wo[1]) ** 2 + z * z
    q = l2 / (x * x + y * y + z * z)
    return 0.25 * q * q / (math.pi * p.alpha_x * p.alpha_y)
