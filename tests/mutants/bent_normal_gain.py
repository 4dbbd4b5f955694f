"""A diffuse base and a lobe of both directions about a normal bent by 25 degrees; viewers along it
get more than there is, those three degrees off do not.

suite: slow
caught by: energy
cause: angle
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    base: float = 0.7
    shine: float = 0.2


domain = {"base": (0.0, 0.7), "shine": (0.0, 0.4)}
isotropic = False
X, Z = math.sin(math.radians(25.0)), math.cos(math.radians(25.0))
N = 800.0


def f(wo, wi, p):
    a = max(0.0, X * wo[0] + Z * wo[2])
    b = max(0.0, X * wi[0] + Z * wi[2])
    return p.base / math.pi + p.shine * (N + 1.0) / (2.0 * math.pi) * (a * b) ** N
