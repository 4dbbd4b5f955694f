"""Deterministic albedos in the domain of half-vector slopes, fitted exactly to the horizon.

With the half vector's slope t = tan(theta_h), its azimuth phi against the view direction and
k = tan(theta_o) cos(phi) (formulas of the slope domain: Walter et al. 2007, eqs. 13-14, and
Heitz 2014),

    A = integral dphi integral_0^t_max f mu_i 4 (h.v) cos^3(theta_h) t dt,   t_max = k + sqrt(k^2+1)

and t_max is the image of mu_i = 0. Both variables are logarithmic in the way the problem is:

    k = sinh y, so t_max = e^y, with y = asinh(tan theta_o) cos(beta), beta uniform;
    t = width sinh v.

So lobes of any width and views at any distance from the horizon cost only logarithmically more
nodes. Nothing here is shared with the charts of the Monte Carlo estimators.
"""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from montecarlo_brdf.references._kinks import SMOOTH, TINY, Kinks
from montecarlo_brdf.references._rules import (
    Array,
    Nodes,
    Sum,
    clustered,
    converge,
    node_count,
    panels,
    total,
)
from montecarlo_brdf.references._truth import sine

SOURCE = "quadrature in half-vector slopes fitted to the horizon"
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


def horizon(k: Array) -> Array:
    """t_max = k + sqrt(k^2 + 1), which cancels for k < 0, in two operations."""
    return np.exp(np.arcsinh(k))


def azimuth_count(tan_o: float, reach: float, breaks: tuple[float, ...]) -> float:
    """Nodes for the half circle, or for each of its parts: geometric in beta.

    Gauss takes as many on half of it as the midpoint rule on all, and three times as many on the
    whole. A lobe that ends before the horizon does and is cut by it on the way is no rational
    function of the horizon but decays like exp(-e^(2y)), which takes more.
    """
    span = math.asinh(tan_o)
    cut = span + math.log(min(reach, 1.0)) if reach < math.inf else 0.0
    factor = 3.0 if breaks == (math.inf,) else 1.0
    return factor * (10.0 + 4.5 * span) + min(10.0 * max(cut, 0.0), 40.0)


def azimuths(tan_o: float, n: int, breaks: tuple[float, ...]) -> tuple[Array, Array]:
    """Nodes k and weights of the integral over the half circle of phi, as columns.

    Without a break: the midpoint rule in beta, geometric because the integrand is periodic.
    With breaks in k (inf: the view's own plane) the integrand is only piecewise smooth: Gauss
    between them.
    """
    end = np.arcsinh(tan_o)
    if not breaks:
        beta, weight = (np.arange(n) + 0.5) * (np.pi / n), np.full(n, np.pi / n)
    else:
        inner = [float(np.arccos(np.arcsinh(k) / end)) for k in breaks if abs(k) < tan_o]
        beta, weight = panels(clustered(n), [0.0, *sorted(inner), np.pi])
    y = end * np.cos(beta)
    # sinh^2(end) - sinh^2(y) = sinh(end - y) sinh(end + y), each without cancellation
    to_end, to_start = 2.0 * end * np.sin(0.5 * beta) ** 2, 2.0 * end * np.cos(0.5 * beta) ** 2
    sine_phi = np.sqrt(np.sinh(to_end) * np.sinh(to_start))  # times tan_o
    return np.sinh(y)[:, None], (weight * end * np.sin(beta) * np.cosh(y) / sine_phi)[:, None]


def slopes(
    mu_o: float, k: Array, edges: list[Array], width: Array | float, n: int
) -> tuple[Geometry, Array]:
    """Nodes in t on every panel from 0 to the edges (columns, like k), and the weights t dt."""
    t_max = horizon(k)
    v, weight = _panels(clustered(n), [np.arcsinh(edge / width) for edge in edges])
    grow, farthest = np.exp(v), np.exp(np.arcsinh(t_max / width))
    shrink, half = 1.0 / grow, 0.5 * width
    t = half * (grow - shrink)
    # t_max - t in factors: it decides mu_i near the horizon. What rounding takes from the first of
    # them, eps/(1 - x) at x of the way to the horizon, meets weights that shrink like 1 - x.
    to_horizon = half * (farthest - grow) * (1.0 + shrink / farthest)
    square = 1.0 + t * t
    mu_i = np.maximum(mu_o * to_horizon * (t + 1.0 / t_max) / square, TINY)
    mu_i = np.minimum(mu_i, 1.0)
    h_n = 1.0 / np.sqrt(square)
    geometry = Geometry(mu_o, mu_i, h_n, mu_o * (1.0 + k * t) * h_n, t, k)
    return geometry, half * weight * t * (grow + shrink)


def _panels(nodes: Nodes, ends: list[Array]) -> tuple[Array, Array]:
    """The rule on every interval from 0 to the ends, which are columns."""
    v, weight = [ends[0] * nodes.x], [ends[0] * nodes.weight]
    for a, b in pairwise(ends):
        v.append(a + (b - a) * nodes.x)
        weight.append((b - a) * nodes.weight)
    if len(ends) == 1:
        return v[0], weight[0]
    return np.concatenate(v, axis=1), np.concatenate(weight, axis=1)


def check_cosine(mu: float) -> None:
    """A direction below or at the horizon has no albedo."""
    if not 0.0 < mu <= 1.0:
        raise ValueError(f"cos_theta must lie in (0, 1], not {mu!r}")


def slope_albedo(
    brdf: Brdf,
    mu_o: float,
    *,
    width: float,
    reach: float = np.inf,
    kinks: Kinks = SMOOTH,
) -> tuple[float, float]:
    """Albedo of an isotropic f and a bound on its error.

    `width` is the lobe's scale in slope, `reach` the slope beyond which it is below 1e-20 of its
    peak, `kinks` where f is not smooth.
    """
    check_cosine(mu_o)
    tan_o = max(sine(mu_o) / mu_o, NORMAL_VIEW)
    n_azimuth = azimuth_count(tan_o, reach, kinks.breaks)
    parts = 1 + kinks.curves  # panels that share the depth

    def n_slope(end: float) -> float:
        return 28.0 + 4.0 * math.asinh(end / width) / parts

    def part(k: Array, edges: list[Array], azimuth_weight: Array, n: int) -> Sum:
        g, weight = slopes(mu_o, k, edges, width, n)
        density = brdf(g) * g.mu_i * g.h_v * (g.h_n * g.h_n * g.h_n)
        return total(8.0 * azimuth_weight * weight * density)  # twice the half circle

    def rule(size: float) -> Sum:
        k, weight = azimuths(tan_o, node_count(size * n_azimuth), kinks.breaks)
        end = np.minimum(horizon(k), reach)
        edges = [*(np.minimum(np.maximum(edge, 0.0), end) for edge in kinks.slopes(k)), end]
        each, i = [], 0
        while i < len(k):  # from the farthest horizon to the nearest, which needs fewer slopes
            n = node_count(size * n_slope(end[i, 0]))
            here = slice(i, i + max(1, TOGETHER // (n * parts)))
            each.append(part(k[here], [edge[here] for edge in edges], weight[here], n))
            i = here.stop
        return Sum(sum(s.value for s in each), sum(s.magnitude for s in each))

    return converge(rule, agreements=2 if kinks.curves or kinks.breaks else 1)
