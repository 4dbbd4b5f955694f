"""Failure 47. The returned weight forgets that the lobe was chosen with probability 1/2."""

import math

from montecarlo_brdf.sampling.warps import random_hemisphere, random_hemisphere_cosine

found_by = ("run", "cover")


def f(wo, wi, p):
    return 0.8 / math.pi


def pdf(wo, wi, p):
    return 0.5 * wi[2] / math.pi + 0.25 / math.pi


def sample(wo, u, p):
    if u[2] < 0.5:  # half of f by either lobe
        w = random_hemisphere(u[0], u[1])
        return w[0], w[1], w[2], 0.8 * w[2]
    w = random_hemisphere_cosine(u[0], u[1])
    return w[0], w[1], w[2], 0.4
