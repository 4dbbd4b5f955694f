"""Failure 46. A view-dependent weight on the diffuse base only."""

import math

found_by = ("run", "reciprocity")


def f(wo, wi, p):
    return 0.8 / math.pi * (1.0 - (1.0 - wo[2]) ** 5)
