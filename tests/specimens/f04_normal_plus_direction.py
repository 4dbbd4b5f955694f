"""Failure 4. n + a uniform direction, not normalised."""

import math

found_by = ("run", "sampling")


def f(wo, wi, p):
    return 0.8 / math.pi


def sample(wo, u, p):
    z = 1.0 - 2.0 * u[0]
    s, phi = math.sqrt(1.0 - z * z), 2.0 * math.pi * u[1]
    return s * math.cos(phi), s * math.sin(phi), 1.0 + z


def pdf(wo, wi, p):
    return wi[2] / math.pi
