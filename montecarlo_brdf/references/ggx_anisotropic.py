"""Anisotropic GGX, height-correlated Smith masking, Schlick's Fresnel.  Heitz 2014, section 5.

Slopes in polar form about the normal, t (cos phi, sin phi), as in `_quadrature`: along phi the
scale of P22 is m = 1/|(cos phi/alpha_x, sin phi/alpha_y)| and k = tan(theta_o) cos(phi - phi_o). D
and masking change within alpha_x/alpha_y of the axes, the horizon within cos theta_o of k = 0:
panels end there, with a double-exponential rule. The albedo depends on phi_o (radians) too.
"""

import math

import numpy as np

from montecarlo_brdf.references._kinks import TINY
from montecarlo_brdf.references._microfacet import schlick
from montecarlo_brdf.references._quadrature import NORMAL_VIEW, horizon, slopes
from montecarlo_brdf.references._rules import (
    Sum,
    converge,
    independent,
    leaning,
    node_count,
    panels,
    tanh_sinh,
    total,
)
from montecarlo_brdf.references._truth import Truth, sine

SOURCE = "quadrature in elliptic half-vector slopes fitted to the horizon"


def _edges(s_o: float, phi_o: float, smooth_x: bool) -> list[float]:
    """Azimuths of the half vector where the integrand changes fast, from 0 to a full turn."""
    x, y = s_o * math.cos(phi_o), s_o * math.sin(phi_o)
    along = (1.0, 0.0) if smooth_x else (0.0, 1.0)
    angles = [i * 0.5 * math.pi for i in range(1, 4)]
    angles += [phi_o + 0.5 * math.pi, phi_o - 0.5 * math.pi]
    # lights on the horizon along the smoother axis are hardly masked: a dent of width alpha
    angles += [math.atan2(y + sign * along[1], x + sign * along[0]) for sign in (1.0, -1.0)]
    turned = sorted(angle % (2.0 * math.pi) for angle in angles)
    edges = [0.0]
    for angle in [*turned, 2.0 * math.pi]:
        if angle - edges[-1] > 1e-9:
            edges.append(angle)
    edges[-1] = 2.0 * math.pi
    return edges


def _integrate(
    mu_o: float, phi_o: float, alpha_x: float, alpha_y: float, f0: float
) -> tuple[float, float]:
    tan_o = max(sine(mu_o) / mu_o, NORMAL_VIEW)
    view_x, view_y = tan_o * math.cos(phi_o), tan_o * math.sin(phi_o)  # slopes of the view
    rough_o = mu_o * math.hypot(1.0, math.hypot(alpha_x * view_x, alpha_y * view_y))
    narrow = math.asinh(tan_o) + abs(math.log(alpha_x / alpha_y))
    n_slope = 20.0 + 4.0 * math.asinh(2.0 * math.hypot(1.0, tan_o) / min(alpha_x, alpha_y))

    edges = _edges(mu_o * tan_o, phi_o, alpha_x < alpha_y)

    def rule(size: float) -> Sum:
        phi, weight = panels(tanh_sinh(int(size * (32.0 + 6.0 * narrow))), edges)
        x, y = np.cos(phi)[:, None], np.sin(phi)[:, None]
        m = 1.0 / np.hypot(x / alpha_x, y / alpha_y)
        k = x * view_x + y * view_y
        g, measure = slopes(mu_o, k, [horizon(k)], m, node_count(size * n_slope))
        # the light's direction times alpha, from w_i = 2 (h.v) h - w_o
        twice = 2.0 * g.h_v * g.h_n * g.t
        light_x, light_y = (
            alpha_x * (twice * x - mu_o * view_x),
            alpha_y * (twice * y - mu_o * view_y),
        )
        rough = np.sqrt(np.maximum(g.mu_i**2 + light_x**2 + light_y**2, TINY))
        masking = 2.0 * g.mu_i / (g.mu_i * rough_o + mu_o * rough)  # G/mu_o
        p22 = 1.0 / (math.pi * alpha_x * alpha_y * (1.0 + (g.t / m) ** 2) ** 2)
        density = p22 * masking * (g.h_v / g.h_n) * schlick(g.h_v, f0)
        return total(weight[:, None] * measure * density)

    return converge(rule)


def albedo(
    cos_theta_o: float, *, alpha_x: float, alpha_y: float, f0: float, phi_o: float = 0.0
) -> Truth:
    return independent(_integrate(cos_theta_o, phi_o, alpha_x, alpha_y, f0), SOURCE)


def bihemispherical(*, alpha_x: float, alpha_y: float, f0: float) -> Truth:
    """The mean over a quadrant of view azimuths too, by the midpoint rule (periodic). Seconds."""
    scale = 3.0 * min(alpha_x, alpha_y)
    spread = max(alpha_x / alpha_y, alpha_y / alpha_x)
    bounds = []

    def rule(size: float) -> Sum:
        n_phi = int(size * (4.0 + 2.0 * spread))
        v, weight = panels(leaning(node_count(24.0 * size)), [0.0, math.asinh(1.0 / scale)])
        mu = np.minimum(scale * np.sinh(v), 1.0)
        phi = (np.arange(n_phi) + 0.5) * (0.5 * np.pi / n_phi)
        parts = [[_integrate(float(m), float(p), alpha_x, alpha_y, f0) for p in phi] for m in mu]
        mean = np.mean(parts, axis=1) * (2.0 * scale * weight * mu * np.cosh(v))[:, None]
        bounds.append(float(np.abs(mean[:, 1]).sum()))
        return total(mean[:, 0])

    value, error = converge(rule, rounds=3, enough=1e-11)
    return independent((value, error + bounds[-1]), SOURCE)
