"""Failure 2.

The pdf says uniform, the sampler is cosine-weighted; a wrong weight cancels it in the picture.
"""

import math

found_by = ("run", "sampling")


def f(wo, wi, p):
    return 0.8 / math.pi


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return 0.5 / math.pi
