"""The energy that height-correlated GGX loses, 1 - E(mu), as a table and how it is computed.

By the weak white furnace, 1 - E is an integral of positive terms: light masked on its way out, and
reflections below the horizon. The azimuth integral of D is known in closed form (formulas.md,
section 6); what is left is one integral over the polar angle, on panels that shrink towards the
mirror direction, the horizon and the normal. The table is a Chebyshev series in z with
1 - sqrt(alpha/(alpha + mu)) proportional to z^4, which takes the sting out of mu ln(mu) at the
horizon; its absolute error is below 5e-11 for alpha >= 1e-4.
"""
from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

from montecarlo_brdf.models._chebyshev import Eight, eight_terms, fitted

TERMS = 64


class Table(NamedTuple):
    """GGX's parameters, the factor that a model wants, and the coefficients of 1 - E."""

    alpha: float
    f0: float
    factor: float
    k0: Eight
    k1: Eight
    k2: Eight
    k3: Eight
    k4: Eight
    k5: Eight
    k6: Eight
    k7: Eight


def lost(mu: float, p: Table) -> float:
    """1 - E(mu)."""
    q = p.alpha / (p.alpha + mu)
    away = mu / (p.alpha + mu) / (1.0 + math.sqrt(q)) / farthest(p.alpha)
    value = table_at(2.0 * math.sqrt(math.sqrt(away)) - 1.0, p)
    return 0.0 if value < 0.0 else value  # at the horizon it is less than the error of the fit


def table_at(t: float, p: Table) -> float:
    """The series at t = 2 z - 1."""
    b, c = eight_terms(p.k7, t, 0.0, 0.0)
    b, c = eight_terms(p.k6, t, b, c)
    b, c = eight_terms(p.k5, t, b, c)
    b, c = eight_terms(p.k4, t, b, c)
    b, c = eight_terms(p.k3, t, b, c)
    b, c = eight_terms(p.k2, t, b, c)
    b, c = eight_terms(p.k1, t, b, c)
    b, c = eight_terms(p.k0, t, b, c)
    return b - t * c


def farthest(alpha: float) -> float:
    """1 - sqrt(alpha/(alpha + mu)) at mu = 1."""
    return 1.0 / (1.0 + alpha) / (1.0 + math.sqrt(alpha / (1.0 + alpha)))


def table(alpha: float, f0: float) -> Table:
    """The table of one alpha."""
    return Table(alpha, f0, 1.0, *coefficients(alpha))


@functools.lru_cache(maxsize=64)
def coefficients(alpha: float) -> tuple[Eight, ...]:
    """The series of one alpha, which takes some 30 ms to make."""
    return fitted(lambda t: lost_exactly(cosine_at(t, alpha), alpha), TERMS)


def cosine_at(t: float, alpha: float) -> float:
    """The cosine that the table has at t in [-1, 1]."""
    away = farthest(alpha) * (0.5 + 0.5 * t) ** 4
    return min(1.0, alpha * away * (2.0 - away) / (1.0 - away) ** 2)


def average_lost(p: Table) -> float:
    """2 integral of (1 - E) mu dmu, over z by Gauss-Legendre."""
    import numpy as np

    alpha = p.alpha
    node, weight = np.polynomial.legendre.leggauss(TERMS)
    total = 0.0
    for t, w in zip(node, weight, strict=True):
        z, mu = 0.5 + 0.5 * t, cosine_at(t, alpha)
        away = farthest(alpha) * z**4
        slope = 8.0 * alpha * farthest(alpha) * z**3 / (1.0 - away) ** 3  # dmu/dz
        total += 0.5 * w * 2.0 * mu * slope * table_at(t, p)
    return float(total)


def lost_exactly(mu: float, alpha: float) -> float:
    """1 - E(mu) by quadrature over the polar angle of wi, down to where h meets the horizon."""
    import numpy as np

    a2 = alpha * alpha
    theta_o = math.atan2(math.sqrt((1.0 - mu) * (1.0 + mu)), mu)
    t, weight = panels(theta_o, mu, alpha)
    mu_i, sine2 = np.abs(np.cos(t)), np.sin(t) ** 2
    stretched_i = np.sqrt(mu_i * mu_i + a2 * sine2)
    stretched_o = math.sqrt(mu * mu + a2 * (1.0 - mu) * (1.0 + mu))
    hidden = a2 * sine2 / (stretched_i + mu_i)
    masked = mu * hidden / (mu_i * stretched_o + mu * stretched_i)
    leaving = np.where(t < 0.5 * math.pi, masked, 1.0) / (mu + stretched_o)
    return float(np.sum(0.5 * weight * np.sin(t) * ring(t, theta_o, a2) * leaving))


def ring(theta_i: Any, theta_o: float, a2: float) -> Any:
    """Integral of D over the azimuth between wi and wo."""
    import numpy as np

    s, d = 0.5 * (theta_i + theta_o), 0.5 * (theta_i - theta_o)
    c2, cd2 = np.cos(s) ** 2, np.cos(d) ** 2
    near = np.sin(d) ** 2 + a2 * cd2
    far = 4.0 * cd2 * (np.sin(s) ** 2 + a2 * c2)
    k = cd2 * (1.0 - a2)
    x = near * far
    mean = 0.5 * (far + 4.0 * c2 * near)
    return 2.0 * a2 * (1.0 + np.sqrt(c2 / x) * k * (4.0 + 2.0 * k * mean / x))


def panels(theta_o: float, mu: float, alpha: float) -> tuple[Any, Any]:
    """Gauss-Legendre nodes and weights on [0, pi - theta_o], panels doubling away from peaks."""
    import numpy as np

    end = math.pi - theta_o
    steps = max(min(alpha, mu), 1e-18) * 2.0 ** np.arange(65)
    cuts = [c + s * g for c in (0.0, theta_o, 0.5 * math.pi) for s in (-1, 1) for g in (0, *steps)]
    edges = np.unique([0.0, end, *(c for c in cuts if 0.0 < c < end)])
    node, weight = np.polynomial.legendre.leggauss(16)
    half = 0.5 * np.diff(edges)[:, None]
    middle = 0.5 * (edges[1:] + edges[:-1])[:, None]
    return (middle + half * node).ravel(), (half * weight).ravel()
