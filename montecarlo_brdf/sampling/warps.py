"""From uniform numbers to points and directions, each with its density.

`u1`, `u2` lie in [0, 1). Densities are per solid angle (1/sr) on spheres and hemispheres and per
area on the disk; all sample the frame n = (0, 0, 1). Square roots and polynomials only, so the
compiler turns a whole loop of them into vector instructions.
Source: Pharr, Jakob, Humphreys, Physically Based Rendering 4e, A.5.
"""

from __future__ import annotations

import math

from montecarlo_brdf.special import turn
from montecarlo_brdf.vectors import Vec


def random_sphere(u1: float, u2: float) -> Vec:
    """Uniform on the unit sphere, pdf 1/(4 pi): z = 1 - 2 u1."""
    c, s = turn(u2)
    r = 2.0 * math.sqrt(u1 * (1.0 - u1))
    return r * c, r * s, 1.0 - 2.0 * u1


def random_disk(u1: float, u2: float) -> tuple[float, float]:
    """Uniform on the unit disk, pdf 1/pi: r = sqrt(u1)."""
    c, s = turn(u2)
    r = math.sqrt(u1)
    return r * c, r * s


def random_hemisphere(u1: float, u2: float) -> Vec:
    """Uniform on the hemisphere, pdf 1/(2 pi): the sphere folded by |z|, no branch, no
    rejection."""
    x, y, z = random_sphere(u1, u2)
    return x, y, abs(z)


def random_hemisphere_cosine(u1: float, u2: float) -> Vec:
    """Cosine-weighted, pdf cos(theta)/pi, with z = sqrt(1 - u1): z never rounds to 0."""
    x, y = random_disk(u1, u2)
    return x, y, math.sqrt(1.0 - u1)


def pdf_hemisphere_cosine(w: Vec) -> float:
    """cos(theta)/pi above the horizon, 0 below."""
    return max(0.0, w[2]) / math.pi
