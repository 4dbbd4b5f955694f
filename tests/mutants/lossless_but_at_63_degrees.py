"""Declared lossless, without parameters; loses 5 % between the angles that are asked.

caught by: limits
cause: angle
"""

import math

lossless = True
disclaims = {"reciprocity": "attenuated one way"}


def f(wo, wi, p):
    t = math.degrees(math.acos(min(1.0, wo[2])))
    return (1.0 - 0.05 * math.exp(-0.5 * ((t - 63.0) / 3.0) ** 2)) / math.pi
