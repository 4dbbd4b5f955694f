"""Bihemispherical albedo: 2 times the integral of A(mu) mu dmu, from a directional albedo."""

from collections.abc import Callable

import numpy as np

from montecarlo_brdf.references._rules import Sum, clustered, converge, node_count

Directional = Callable[[float], tuple[float, float]]


def hemispherical_mean(
    albedo: Directional, width: float, breaks: tuple[float, ...] = ()
) -> tuple[float, float]:
    """2 int A(mu) mu dmu and its error bound.

    A changes on the scale `width` next to the horizon, hence mu = width sinh v; it has kinks in mu
    at the breaks.
    """
    inside = [b for b in breaks if 0.0 < b < 1.0]
    edges = np.arcsinh(np.array([0.0, *inside, 1.0]) / width)

    def rule(size: float) -> Sum:
        value = bound = 0.0
        for a, b in zip(edges[:-1], edges[1:], strict=True):
            nodes = clustered(node_count(size * (8.0 + 2.0 * (b - a))))
            for v, weight in zip(a + (b - a) * nodes.x, (b - a) * nodes.weight, strict=True):
                mu = min(width * float(np.sinh(v)), 1.0)
                mean, error = albedo(mu)
                weight *= 2.0 * mu * width * np.cosh(v)
                value, bound = value + weight * mean, bound + weight * error
        bounds.append(bound)
        return Sum(value, abs(value))

    bounds: list[float] = []
    value, error = converge(rule)
    return value, error + bounds[-1]
