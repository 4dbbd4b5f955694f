"""Fresnel reflectance as a function of x = h.v, in forms without cancellation."""

from typing import Any

import numpy as np

from montecarlo_brdf.references._rules import Array


def schlick(x: Array, f0: float) -> Array:
    """Schlick 1994: f0 + (1 - f0)(1 - x)^5."""
    y = 1.0 - x
    square = y * y
    return f0 + (1.0 - f0) * (square * square * y)


def fresnel(x: Array, eta: float, k: float = 0.0) -> Array:
    """Exact unpolarised reflectance for the index m = eta + i k against 1.

    With g^2 = m^2 - 1 + x^2 the amplitudes (x-g)/(x+g) and (m^2 x-g)/(m^2 x+g) are rewritten so
    that m -> 1 costs no digits. Total internal reflection (eta < 1) comes out as exactly 1.
    """
    m = eta if k == 0.0 and eta >= 1.0 else complex(eta, k)
    m2, above_one = m * m, (m - 1.0) * (m + 1.0)
    g = np.sqrt(above_one + x * x)
    senkrecht = 1.0 / _norm(x + g) ** 2
    parallel = _norm(x * x * (m2 + 1.0) - 1.0) / _norm(m2 * x + g) ** 2
    return 0.5 * abs(above_one) ** 2 * (senkrecht + parallel)


def _norm(z: Any) -> Array:
    """|z|^2 without the square root of abs."""
    return z.real**2 + z.imag**2 if np.iscomplexobj(z) else z * z
