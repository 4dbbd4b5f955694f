"""pow() of a negative cosine with an exponent that is not whole.

caught by: positivity
cause: root or power of a negative
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.9
    n: float = 32.5


domain = {"ks": (0.0, 1.0), "n": (0.0, 1000.0)}


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normalize(v):
    length = math.sqrt(dot(v, v))
    return v[0] / length, v[1] / length, v[2] / length


def mirror(wo):
    return -wo[0], -wo[1], wo[2]


def f(wo, wi, p):
    c = dot(mirror(wo), wi)
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * c**p.n
