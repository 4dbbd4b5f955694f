"""Declared lossless whatever the parameters; the coat, 0 by default, takes a little each way.

suite: slow
caught by: limits
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    gloss: float = 0.5
    coat: float = 0.0


domain = {"gloss": (0.0, 1.0), "coat": (0.0, 1.0)}
lossless = True


def f(wo, wi, p):
    way = 0.02 * p.coat * p.gloss
    return (1.0 - way) / math.pi
