"""Deterministic albedos in the domain of half-vector slopes, fitted exactly to the horizon.

With the half vector's slope t = tan(theta_h), its azimuth phi against the view direction and
k = tan(theta_o) cos(phi) (formulas of the slope domain: Walter et al. 2007, eqs. 13-14, and
Heitz 2014),

    A = integral dphi integral_0^t_max f mu_i 4 (h.v) cos^3(theta_h) t dt,   t_max = k + sqrt(k^2+1)

and t_max is the image of mu_i = 0. Both variables are logarithmic in the way the problem is:

    k = sinh y, so t_max = e^y, with y = asinh(tan theta_o) cos(beta), beta uniform;
    t = width sinh v.

So lobes of any width and views at any distance from the horizon cost only logarithmically more
nodes. Nothing here is shared with the charts of the Monte Carlo estimators. `quadrature` takes any
f whatever, at a hundred times the cost.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from montecarlo_brdf.references._adaptive import quadrature as quadrature
from montecarlo_brdf.references._rules import (
    Array,
    Sum,
    clustered,
    converge,
    node_count,
    panels,
    total,
)
from montecarlo_brdf.references._truth import sine

TINY = 1e-300
# A depends on tan(theta_o) through its square: below this the view is the normal, to 1e-18
NORMAL_VIEW = 1e-9
# nodes evaluated together: larger arrays leave the cache and go back to the system every time
TOGETHER = 4096


class Geometry(NamedTuple):
    """All that an isotropic reflection depends on; t = tan(theta_h), k = tan(theta_o) cos(phi)."""

    mu_o: float
    mu_i: Array
    h_n: Array
    h_v: Array
    t: Array
    k: Array


Brdf = Callable[[Geometry], Array]
Kinks = Callable[[Array], tuple[Array, ...]]


def horizon(k: Array) -> Array:
    """t_max = k + sqrt(k^2 + 1), which cancels for k < 0."""
    size = np.abs(k) + np.sqrt(k * k + 1.0)
    return np.where(k > 0.0, size, 1.0 / size)


def azimuths(tan_o: float, n: int, break_at: float | None) -> tuple[Array, Array]:
    """Nodes k and weights of the integral over the half circle of phi, as columns.

    Without a break: the midpoint rule in beta, geometric because the integrand is periodic.
    With a break at k = break_at (the view's own plane if that is beyond tan_o) the integrand is
    only piecewise smooth: Gauss on either side.
    """
    end = np.arcsinh(tan_o)
    if break_at is None:
        beta, weight = (np.arange(n) + 0.5) * (np.pi / n), np.full(n, np.pi / n)
    else:
        edges = [0.0, np.pi]
        if abs(break_at) < tan_o:
            edges.insert(1, float(np.arccos(np.arcsinh(break_at) / end)))
        beta, weight = panels(clustered(n), edges)
    y = end * np.cos(beta)
    # sinh^2(end) - sinh^2(y) = sinh(end - y) sinh(end + y), each without cancellation
    to_end, to_start = 2.0 * end * np.sin(0.5 * beta) ** 2, 2.0 * end * np.cos(0.5 * beta) ** 2
    sine_phi = np.sqrt(np.sinh(to_end) * np.sinh(to_start))  # times tan_o
    return np.sinh(y)[:, None], (weight * end * np.sin(beta) * np.cosh(y) / sine_phi)[:, None]


def slopes(
    mu_o: float, k: Array, edges: list[Array], width: Array | float, n: int
) -> tuple[Geometry, Array]:
    """Nodes in t on every panel between the edges (columns, like k), and the weights t dt."""
    t_max = horizon(k)
    nodes = clustered(n)
    last = np.arcsinh(t_max / width)
    ends = [np.arcsinh(edge / width) for edge in edges]
    spans = list(pairwise(ends))
    v = np.concatenate([a + (b - a) * nodes.x for a, b in spans], axis=1)
    weight = np.concatenate([(b - a) * nodes.weight for a, b in spans], axis=1)
    grow, farthest = np.exp(v), np.exp(last)
    shrink = 1.0 / grow
    t = (0.5 * width) * (grow - shrink)
    # t_max - t in factors: it decides mu_i near the horizon. What rounding takes from the first of
    # them, eps/(1 - x) at x of the way to the horizon, meets weights that shrink like 1 - x.
    to_horizon = (0.5 * width) * (farthest - grow) * (1.0 + shrink / farthest)
    square = 1.0 + t * t
    mu_i = np.maximum(mu_o * to_horizon * (t + 1.0 / t_max) / square, TINY)
    mu_i = np.minimum(mu_i, 1.0)
    h_n = 1.0 / np.sqrt(square)
    geometry = Geometry(mu_o, mu_i, h_n, mu_o * (1.0 + k * t) * h_n, t, k)
    return geometry, weight * t * (0.5 * width) * (grow + shrink)


def slope_albedo(
    brdf: Brdf,
    mu_o: float,
    *,
    width: float,
    reach: float = np.inf,
    kinks: Kinks | None = None,
    azimuth_break: float | None = None,
) -> tuple[float, float]:
    """Albedo of an isotropic f and a bound on its error.

    `width` is the lobe's scale in slope, `reach` the slope beyond which it is below 1e-20 of its
    peak, `kinks(k)` the slopes at which f has a kink, `azimuth_break` the k at which they change
    their order.
    """
    if not 0.0 < mu_o <= 1.0:
        raise ValueError(f"cos_theta must lie in (0, 1], not {mu_o!r}")
    tan_o = max(sine(mu_o) / mu_o, NORMAL_VIEW)
    depth = np.arcsinh(min(tan_o + np.hypot(tan_o, 1.0), reach) / width)
    # Gauss on half the circle takes as many, on the whole three times the midpoint rule's nodes
    factor = 3.0 if azimuth_break == np.inf else 1.0
    parts = 1 + (len(kinks(np.zeros(1))) if kinks else 0)  # panels that share the depth
    n_azimuth, n_slope = factor * (8.0 + 6.0 * np.arcsinh(tan_o)), 24.0 + 4.0 * depth / parts

    def part(k: Array, azimuth_weight: Array, n: int) -> Sum:
        end = np.minimum(horizon(k), reach)
        inner = [np.clip(edge, 0.0, end) for edge in (kinks(k) if kinks else ())]
        g, weight = slopes(mu_o, k, [np.zeros_like(k), *inner, end], width, n)
        density = brdf(g) * g.mu_i * g.h_v * (g.h_n * g.h_n * g.h_n)
        return total(8.0 * azimuth_weight * weight * density)  # twice the half circle

    def rule(size: float) -> Sum:
        k, weight = azimuths(tan_o, node_count(size * n_azimuth), azimuth_break)
        n = node_count(size * n_slope)
        step = max(1, TOGETHER // (n * parts))
        each = [part(k[i : i + step], weight[i : i + step], n) for i in range(0, len(k), step)]
        return Sum(sum(s.value for s in each), sum(s.magnitude for s in each))

    return converge(rule)
