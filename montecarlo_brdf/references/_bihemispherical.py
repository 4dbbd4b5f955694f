"""Bihemispherical albedo: 2 times the integral of A(mu) mu dmu, from a directional albedo."""

from collections.abc import Callable

import numpy as np

from montecarlo_brdf.references._rules import (
    Sum,
    clustered,
    converge,
    leaning,
    node_count,
    panels,
    total,
)

Directional = Callable[[float], tuple[float, float]]


def hemispherical_mean(
    albedo: Directional, width: float, breaks: tuple[float, ...] = ()
) -> tuple[float, float]:
    """2 int A(mu) mu dmu and its error bound.

    A changes on the scale `width` next to the horizon, hence mu = 3 width sinh v; the first panel's
    nodes lean towards mu = 0, where A may have a logarithm. A has kinks in mu at the breaks;
    a break at 1 says that it is not smooth at the normal.
    """
    inside = [b for b in breaks if 0.0 < b < 1.0]
    scale = 3.0 * width
    edges = np.arcsinh(np.array([0.0, *inside, 1.0]) / scale)

    def rule(size: float) -> Sum:
        nodes = (clustered if breaks else leaning)(node_count(size * (20.0 + edges[-1])))
        v, weight = panels(nodes, edges)
        mu = np.minimum(scale * np.sinh(v), 1.0)
        parts = np.array([albedo(float(m)) for m in mu])
        weighted = parts * (2.0 * scale * weight * mu * np.cosh(v))[:, None]
        bounds.append(float(np.abs(weighted[:, 1]).sum()))
        return total(weighted[:, 0])

    bounds: list[float] = []
    value, error = converge(rule, agreements=2)  # A may be smooth on no scale that is known
    return value, error + bounds[-1]
