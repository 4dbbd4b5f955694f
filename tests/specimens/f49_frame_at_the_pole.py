"""Failure 49.

A frame from the cross product with the normal, which is zero for light straight on.
"""

import math

from montecarlo_brdf.vectors import cross, mirrored, normalised

found_by = ("stress", "float64")


def f(wo, wi, p):
    c = max(0.0, wi[2] * wo[2] - wi[0] * wo[0] - wi[1] * wo[1])
    return 0.5 / math.pi * c


def sample(wo, u, p):
    r = mirrored(wo)
    t = normalised(cross((0.0, 0.0, 1.0), r))
    b = cross(r, t)
    c, phi = math.sqrt(1.0 - u[0]), 2.0 * math.pi * u[1]
    x, y = math.sqrt(u[0]) * math.cos(phi), math.sqrt(u[0]) * math.sin(phi)
    return (
        x * t[0] + y * b[0] + c * r[0],
        x * t[1] + y * b[1] + c * r[1],
        x * t[2] + y * b[2] + c * r[2],
    )


def pdf(wo, wi, p):
    return max(0.0, wi[2] * wo[2] - wi[0] * wo[0] - wi[1] * wo[1]) / math.pi
