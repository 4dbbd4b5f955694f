"""Anisotropic GGX, height-correlated Smith masking, Schlick's Fresnel.  Heitz 2014, section 5.

Elliptic slopes t = r (alpha_x cos psi, alpha_y sin psi) make P22 circular, 1/(pi (1 + r^2)^2) per
dr dpsi, so that only the horizon knows of the anisotropy: along psi the scale of t is
m = |(alpha_x cos psi, alpha_y sin psi)|, and k = tan(theta_o) cos(phi_h - phi_o) as in
`_quadrature`. The albedo depends on the azimuth phi_o (radians) too.
"""

import math

import numpy as np

from montecarlo_brdf.references import _fresnel
from montecarlo_brdf.references._bihemispherical import hemispherical_mean
from montecarlo_brdf.references._quadrature import NORMAL_VIEW, TINY, azimuths, slopes
from montecarlo_brdf.references._rules import Array, Sum, converge, independent, node_count, total
from montecarlo_brdf.references._truth import Truth, sine

RECIPROCAL = True
SOURCE = "quadrature in elliptic half-vector slopes fitted to the horizon"


def _circle(tan_o: float, n: int, first: float) -> tuple[Array, Array]:
    """Columns psi and weights over the full circle, denser where k changes sign."""
    k, weight = azimuths(tan_o, n, None)
    turn = np.arctan2(np.sqrt((tan_o - k) * (tan_o + k)), k)
    return first + np.concatenate([turn, -turn]), np.concatenate([weight, weight])


def _integrate(
    mu_o: float, phi_o: float, alpha_x: float, alpha_y: float, f0: float
) -> tuple[float, float]:
    tan_o = max(sine(mu_o) / mu_o, NORMAL_VIEW)
    view_x, view_y = tan_o * math.cos(phi_o), tan_o * math.sin(phi_o)  # slopes of the view
    along = math.hypot(alpha_x * view_x, alpha_y * view_y)
    first = math.atan2(alpha_y * view_y, alpha_x * view_x)
    across = math.hypot(alpha_x * math.sin(first), alpha_y * math.cos(first))
    stretched, rough_o = max(along / across, NORMAL_VIEW), mu_o * math.hypot(1.0, along)
    ratio = max(alpha_x / alpha_y, alpha_y / alpha_x)
    n_azimuth = (8.0 + 6.0 * math.asinh(stretched)) * math.sqrt(ratio)
    n_slope = 20.0 + 4.0 * math.asinh(2.0 * math.hypot(1.0, tan_o) / min(alpha_x, alpha_y))

    def rule(size: float) -> Sum:
        psi, weight = _circle(stretched, node_count(size * n_azimuth), first)
        axis_x, axis_y = alpha_x * np.cos(psi), alpha_y * np.sin(psi)
        m = np.hypot(axis_x, axis_y)
        k = (axis_x * view_x + axis_y * view_y) / m
        end = np.where(k > 0.0, k + np.hypot(k, 1.0), 1.0 / (np.hypot(k, 1.0) + np.abs(k)))
        g, measure = slopes(mu_o, k, [np.zeros_like(k), end], m, node_count(size * n_slope))
        r = g.t / m
        # the light's direction times alpha, from w_i = 2 (h.v) h - w_o
        twice = 2.0 * g.h_v * g.h_n * r
        light_x = alpha_x * (twice * axis_x - mu_o * view_x)
        light_y = alpha_y * (twice * axis_y - mu_o * view_y)
        rough = np.sqrt(np.maximum(g.mu_i**2 + light_x**2 + light_y**2, TINY))
        # F G D mu_i dw_i / (4 mu_i mu_o): D dw_h cos = dr dpsi r/(pi (1 + r^2)^2), G as in _ggx
        masking = 2.0 * g.mu_i / (g.mu_i * rough_o + mu_o * rough)
        density = g.h_v / g.h_n / (math.pi * (m * (1.0 + r * r)) ** 2)
        return total(weight * measure * density * masking * _fresnel.schlick(g.h_v, f0))

    return converge(rule)


def albedo(
    cos_theta_o: float, *, alpha_x: float, alpha_y: float, f0: float, phi_o: float = 0.0
) -> Truth:
    return independent(_integrate(cos_theta_o, phi_o, alpha_x, alpha_y, f0), SOURCE)


def bihemispherical(*, alpha_x: float, alpha_y: float, f0: float) -> Truth:
    """The mean over the view's azimuth of one quadrant, by the midpoint rule (periodic)."""

    def mean(mu: float) -> tuple[float, float]:
        def rule(size: float) -> Sum:
            phi = (np.arange(int(4 * size)) + 0.5) * (0.5 * np.pi / int(4 * size))
            parts = [_integrate(mu, p, alpha_x, alpha_y, f0) for p in phi]
            bounds.append(max(error for _, error in parts))
            return Sum(*(2 * [sum(value for value, _ in parts) / len(parts)]))

        bounds: list[float] = []
        value, error = converge(rule)
        return value, error + bounds[-1]

    return independent(hemispherical_mean(mean, min(alpha_x, alpha_y)), SOURCE)
