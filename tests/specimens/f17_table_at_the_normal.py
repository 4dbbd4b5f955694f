"""Failure 17.

A difference angle divided by the sine of the half angle: 0/0 where light = view = normal.
"""

import math

from montecarlo_brdf.vectors import half_vector

found_by = ("run", "positivity")


def f(wo, wi, p):
    h = half_vector(wi, wo)
    across = (wi[1] * h[0] - wi[0] * h[1]) / math.sqrt(h[0] * h[0] + h[1] * h[1])
    return (0.5 + 0.1 * across * across) / math.pi
