"""E(mu): the albedo of GGX with height-correlated Smith masking and F = 1, as a 1-D integral.

The integral of D over the azimuth of the light is elementary. With sigma, delta =
(theta_i +- theta_o)/2,

    P- = 4 cos^2(sigma) (sin^2(delta) + alpha^2 cos^2(delta)),
    P+ = 4 cos^2(delta) (sin^2(sigma) + alpha^2 cos^2(sigma)),
    a = 4 cos^2(sigma) cos^2(delta) (1 - alpha^2),
    integral D dphi = 2 alpha^2 [1 + 2 a/sqrt(P- P+) + a^2 (P- + P+)/(2 (P- P+)^(3/2))],

sums of positive terms for alpha <= 1 at any angle. Elevations above the horizon keep the digits
near grazing, polar angles those near the normal. Independent of the slope-domain quadrature.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from montecarlo_brdf.references._rules import (
    Array,
    Sum,
    converge,
    hemispherical_mean,
    tanh_sinh,
    total,
)
from montecarlo_brdf.references._truth import sine


class _Directions(NamedTuple):
    """Lights on one side of the view, as angles that keep digits at the normal and grazing."""

    elevation: Array
    theta: Array
    away: Array  # |theta_i - theta_o|
    weight: Array


def _around(light: _Directions, elevation_o: float, theta_o: float, alpha: float) -> Array:
    cos_sigma2 = np.sin(0.5 * (light.elevation + elevation_o)) ** 2
    sin_sigma2 = np.sin(0.5 * (light.theta + theta_o)) ** 2
    cos_delta2, sin_delta2 = np.cos(0.5 * light.away) ** 2, np.sin(0.5 * light.away) ** 2
    minus = 4.0 * cos_sigma2 * (sin_delta2 + alpha**2 * cos_delta2)
    plus = 4.0 * cos_delta2 * (sin_sigma2 + alpha**2 * cos_sigma2)
    a = 4.0 * cos_sigma2 * cos_delta2 * (1.0 - alpha) * (1.0 + alpha)
    root = np.sqrt(minus * plus)
    ratio: Array = a / root
    return 2.0 * alpha**2 * (1.0 + ratio * (2.0 + 0.5 * ratio * (minus + plus) / root))


def unit_albedo(mu_o: float, alpha: float) -> tuple[float, float]:
    """E(mu_o) and a bound on its error."""
    if not 0.0 < mu_o <= 1.0:
        raise ValueError(f"cos_theta must lie in (0, 1], not {mu_o!r}")
    s_o = sine(mu_o)
    up, theta = math.atan2(mu_o, s_o), math.atan2(s_o, mu_o)

    def terms(light: _Directions) -> Array:
        mu, s = np.sin(light.elevation), np.sin(light.theta)
        rough, rough_o = np.hypot(mu, alpha * s), np.hypot(mu_o, alpha * s_o)
        smith = 2.0 / (mu_o * rough + mu * rough_o)  # G/(mu_i mu_o)
        around: Array = light.weight * _around(light, up, theta, alpha) * 0.25 * smith * mu * s
        return around

    def rule(size: float) -> Sum:
        x, rest, weight = tanh_sinh(2 * int(size * (40.0 - 8.0 * math.log(alpha))))
        below = _Directions(up * x, theta + up * rest, up * rest, up * weight)
        above = _Directions(up + theta * x, theta * rest, theta * x, theta * weight)
        return total(np.concatenate([terms(below), terms(above)]))

    return converge(rule)


@lru_cache(maxsize=64)
def mean_albedo(alpha: float) -> tuple[float, float]:
    """The bihemispherical mean of E and a bound on its error."""
    return hemispherical_mean(lambda mu: unit_albedo(mu, alpha), alpha)


DEGREE, DEEPEST = 19, 40
TABLE_ERROR = 2e-12  # relative: the bound of `unit_albedo` and of a degree-19 series on an octave


@lru_cache(maxsize=512)
def _octave(alpha: float, depth: int) -> Array:
    """Chebyshev series of E on 2^-(depth+1) <= mu <= 2^-depth.

    E is analytic but for branch points at mu = +-i alpha and a logarithm at 0, none nearer to an
    octave than 0.7 of its end.
    """
    angle = np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1)
    mu = 2.0**-depth * (0.75 + 0.25 * np.cos(angle))
    values = np.array([unit_albedo(float(m), alpha)[0] for m in mu])
    return np.polynomial.chebyshev.chebfit(np.cos(angle), values, DEGREE)


def unit_albedo_table(mu: Array, alpha: float) -> Array:
    """E at many cosines; below 2^-40 it is constant to 1e-11, where nothing weighs that much."""
    mu = np.maximum(mu, 2.0**-DEEPEST)
    depth = -np.frexp(mu)[1]
    values = np.empty_like(mu)
    for d in np.unique(depth):
        here = depth == d
        x = 4.0 * (mu[here] * 2.0**d - 0.75)
        values[here] = np.polynomial.chebyshev.chebval(x, _octave(alpha, int(max(d, 0))))
    return values
