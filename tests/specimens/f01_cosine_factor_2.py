"""Failure 1.

A cosine sample with x and y doubled is no unit vector, printed in a book for years.
"""

import math

found_by = ("run", "sampling")


def f(wo, wi, p):
    return 0.8 / math.pi


def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return 2.0 * r * math.cos(phi), 2.0 * r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
