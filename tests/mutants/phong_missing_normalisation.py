"""Phong as printed in 1975: no normalisation at all.

caught by: equality
cause: normalisation
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.9
    n: float = 32.0


domain = {"ks": (0.0, 1.0), "n": (0.0, 1000.0)}
same_as = "phong"


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def mirror(wo):
    return -wo[0], -wo[1], wo[2]


def f(wo, wi, p):
    c = max(0.0, dot(mirror(wo), wi))
    return p.ks * c**p.n
