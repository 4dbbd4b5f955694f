"""Oren-Nayar, the full model with interreflection.  Oren & Nayar, SIGGRAPH 1994, eqs. 27-29.

The azimuth integral is elementary, and the two half-planes of C2 leave only its last term:

    A = albedo A1 + 0.17 albedo^2 sigma^2/(sigma^2 + 0.13)
        + albedo/pi int mu_i s_i [2 B (2b/pi)^3 tan b + (2 pi - 4) C3 tan((a+b)/2)] dtheta_i

with a, b the larger and the smaller polar angle and C3 = sigma^2/(sigma^2 + 0.09)/8 (4ab/pi^2)^2.
tan((a+b)/2) is the cotangent of half the sum of the elevations: no digits are lost at grazing.
"""

import math

import numpy as np

from montecarlo_brdf.references._rules import (
    Array,
    Sum,
    converge,
    hemispherical_mean,
    independent,
    tanh_sinh,
    total,
)
from montecarlo_brdf.references._truth import EPSILON, Truth, sine
from montecarlo_brdf.references.oren_nayar import constants

SOURCE = "1-D quadrature, azimuth in closed form"


def _integral(mu_o: float, sigma: float) -> tuple[float, float]:
    """The integral over theta_i, split at theta_o."""
    b_constant = constants(sigma)[1]
    c3 = 0.125 * sigma * sigma / (sigma * sigma + 0.09) * (4.0 / math.pi**2) ** 2
    s_o = sine(mu_o)
    up, theta_o = math.atan2(mu_o, s_o), math.atan2(s_o, mu_o)

    def terms(y: Array, theta: Array, mu_tan_b: Array) -> Array:
        mean = (2.0 * math.pi - 4.0) * c3 * (theta * theta_o) ** 2 / np.tan(0.5 * (y + up))
        shade = 2.0 * b_constant * (2.0 / math.pi * np.minimum(theta, theta_o)) ** 3
        return np.sin(theta) * (shade * mu_tan_b + mean * np.sin(y))

    def rule(size: float) -> Sum:
        x, rest, weight = tanh_sinh(2 * int(size * (40.0 - 4.0 * math.log(mu_o))))
        y, theta = up * x, theta_o + up * rest
        below = up * weight * terms(y, theta, np.sin(y) * s_o / mu_o)
        y, theta = up + theta_o * x, theta_o * rest
        above = theta_o * weight * terms(y, theta, np.sin(theta))
        return total(np.concatenate([below, above]))

    return converge(rule)


def _directional(mu_o: float, albedo: float, sigma: float) -> tuple[float, float]:
    variance = sigma * sigma
    interreflection = 0.17 * albedo * variance / (variance + 0.13)
    constant = albedo * (constants(sigma)[0] + interreflection)
    value, error = _integral(mu_o, sigma)
    scale = albedo / math.pi
    return constant + scale * value, scale * error + 8.0 * EPSILON * constant


def albedo(cos_theta_o: float, *, albedo: float, sigma: float) -> Truth:
    return independent(_directional(cos_theta_o, albedo, sigma), SOURCE)


def bihemispherical(*, albedo: float, sigma: float) -> Truth:
    width = 0.1  # of the change near the horizon
    return independent(
        hemispherical_mean(lambda mu: _directional(mu, albedo, sigma), width), SOURCE
    )
