"""Failure 21. acos of a dot product that rounding pushed beyond 1."""

import math

found_by = ("stress", "float64")


def f(wo, wi, p):
    g = math.acos(wi[0] * wo[0] + wi[1] * wo[1] + wi[2] * wo[2])
    return 0.5 / math.pi * (1.0 + 0.2 * g)
