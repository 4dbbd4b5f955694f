"""Exact Fresnel reflectance at x = h.v, unpolarised, in forms without cancellation.

With g^2 = m^2 - 1 + x^2 for a refractive index m, the amplitudes are
(x - g)/(x + g) = (1 - m^2)/(x + g)^2 and
(m^2 x - g)/(m^2 x + g) = (m^2 - 1)((m^2 + 1) x^2 - 1)/(m^2 x + g)^2, 0 for m = 1 as they should be.
m^2 - 1 is (m - 1)(m + 1): rounding m^2 first would leave a relative error of 1e-16/(m - 1).
"""
from __future__ import annotations

import math

TINY = 1e-150  # keeps 0/0 from happening where g = 0


def dielectric(x: float, eta: float) -> float:
    """Born & Wolf, section 1.5.2, for a real index eta >= 1."""
    m, above_one = eta * eta, (eta - 1.0) * (eta + 1.0)
    g = math.sqrt(above_one + x * x)
    q, r = x + g, m * x + g
    s = above_one / (q * q)
    p = above_one * ((m + 1.0) * x * x - 1.0) / (r * r)
    return 0.5 * (s * s + p * p)


def complex_root(a: float, b: float) -> tuple[float, float]:
    """(real, imaginary) part of sqrt(a + i b), b >= 0."""
    big = math.sqrt(0.5 * (math.sqrt(a * a + b * b) + abs(a)))
    small = 0.5 * b / (big + TINY)
    return (big, small) if a >= 0.0 else (small, big)


def conductor(x: float, eta: float, k: float) -> float:
    """Born & Wolf, section 14.2, for a complex index eta + i k."""
    m, n = eta * eta - k * k, 2.0 * eta * k
    above_one = (eta - 1.0) * (eta + 1.0) - k * k
    g, h = complex_root(above_one + x * x, n)
    contrast = above_one * above_one + n * n
    q = (x + g) * (x + g) + h * h
    r = (m * x + g) * (m * x + g) + (n * x + h) * (n * x + h)
    u, v = (m + 1.0) * x * x - 1.0, n * x * x
    return 0.5 * contrast * (1.0 / (q * q) + (u * u + v * v) / (r * r))
