"""Failure 16. A frame from the cross product of wi and wo, which is zero where they are equal."""

import math

from montecarlo_brdf.vectors import cross, length

found_by = ("run", "positivity")


def f(wo, wi, p):
    c = cross(wi, wo)
    axis = c[2] / length(c)
    return (0.5 + 0.1 * axis * axis) / math.pi
