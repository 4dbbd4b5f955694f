"""Failure 10. The returned weight is f cos, not divided by the pdf."""

import math

found_by = ("run", "pdf")


def f(wo, wi, p):
    return 0.8 / math.pi


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    z = math.sqrt(1.0 - u[0])
    return r * math.cos(phi), r * math.sin(phi), z, 0.8 / math.pi * z


def pdf(wo, wi, p):
    return wi[2] / math.pi
