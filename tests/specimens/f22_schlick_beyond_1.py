"""Failure 22. Schlick's (1 - cos)^5 by log, with a cosine that rounding pushed beyond 1."""

import math

from montecarlo_brdf.vectors import dot, half_vector

found_by = ("stress", "float64")


def f(wo, wi, p):
    c = dot(half_vector(wi, wo), wi)
    return (0.04 + 0.96 * math.exp(5.0 * math.log(1.0 - c))) / 4.0
