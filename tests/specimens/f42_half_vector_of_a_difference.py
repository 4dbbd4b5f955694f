"""Failure 42. h = L - V: no half vector where light and view agree."""

import math

from montecarlo_brdf.vectors import normalised

found_by = ("run", "positivity")


def f(wo, wi, p):
    h = normalised((wi[0] - wo[0], wi[1] - wo[1], wi[2] - wo[2]))
    return 0.2 / math.pi * (1.0 + h[2] * h[2])
