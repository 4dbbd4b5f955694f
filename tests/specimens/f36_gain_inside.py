"""Failure 36.

Energy right at metalness 0 and 1, too much between: a blend of products for a product of
blends.
"""

import math
from typing import NamedTuple

found_by = ("run", "energy")
domain = {"metalness": (0.0, 1.0)}


class Params(NamedTuple):
    metalness: float = 0.0


def f(wo, wi, p):
    return (1.0 + 0.4 * p.metalness * (1.0 - p.metalness)) * 0.95 / math.pi
