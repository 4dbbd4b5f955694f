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


def table_at(t: Any, p: Table) -> Any:
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


@functools.lru_cache(maxsize=1024)
def coefficients(alpha: float) -> tuple[Eight, ...]:
    """The series of one alpha, which takes some milliseconds to make."""
    return fitted(lambda t: lost_exactly(cosine_at(t, alpha), alpha), TERMS)


def cosine_at(t: Any, alpha: float) -> Any:
    """The cosines that the table has at t in [-1, 1]."""
    import numpy as np

    away = farthest(alpha) * (0.5 + 0.5 * t) ** 4
    return np.minimum(1.0, alpha * away * (2.0 - away) / (1.0 - away) ** 2)


def average_lost(p: Table) -> float:
    """2 integral of (1 - E) mu dmu, over z by Gauss-Legendre."""
    import numpy as np

    t, weight = legendre(TERMS)
    z, most = 0.5 + 0.5 * t, farthest(p.alpha)
    slope = 8.0 * p.alpha * most * z**3 / (1.0 - most * z**4) ** 3  # dmu/dz
    return float(np.sum(weight * cosine_at(t, p.alpha) * slope * table_at(t, p)))


def lost_exactly(mu: Any, alpha: float) -> Any:
    """1 - E at cosines mu by quadrature over the polar angle of wi, down to where h meets the
    horizon."""
    import numpy as np

    a2, cosines = alpha * alpha, np.atleast_1d(np.asarray(mu, dtype=float))
    angles = np.arctan2(np.sqrt((1.0 - cosines) * (1.0 + cosines)), cosines)
    t, weight, which = panels(angles, cosines, alpha)
    mu_o, theta_o = cosines[which], angles[which]
    mu_i, sine2 = np.abs(np.cos(t)), np.sin(t) ** 2
    stretched_i = np.sqrt(mu_i * mu_i + a2 * sine2)
    stretched_o = np.sqrt(mu_o * mu_o + a2 * (1.0 - mu_o) * (1.0 + mu_o))
    hidden = a2 * sine2 / (stretched_i + mu_i)
    masked = mu_o * hidden / (mu_i * stretched_o + mu_o * stretched_i)
    leaving = np.where(t < 0.5 * math.pi, masked, 1.0) / (mu_o + stretched_o)
    parts = 0.5 * weight * np.sin(t) * ring(t, theta_o, a2) * leaving
    return np.bincount(which, parts, len(cosines)).reshape(np.shape(mu))


def ring(theta_i: Any, theta_o: Any, a2: float) -> Any:
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


def panels(theta_o: Any, mu: Any, alpha: float) -> tuple[Any, Any, Any]:
    """Gauss-Legendre nodes and weights on [0, pi - theta_o] of each angle, and whose they are:
    panels double away from the peaks."""
    import numpy as np

    first = np.maximum(np.minimum(alpha, mu), 1e-18)[:, None]
    steps = first * 2.0 ** np.arange(1 + math.ceil(math.log2(math.pi / first.min())))
    moves = np.concatenate([-steps, 0.0 * first, steps], axis=1)
    peaks = (0.0, theta_o[:, None], 0.5 * math.pi)
    cuts = np.concatenate([np.zeros_like(first), *(peak + moves for peak in peaks)], axis=1)
    cuts = np.sort(np.clip(cuts, 0.0, math.pi - theta_o[:, None]), axis=1)
    which, place = np.nonzero(cuts[:, 1:] > cuts[:, :-1])
    low, high = cuts[which, place][:, None], cuts[which, place + 1][:, None]
    node, weight = legendre(16)
    half = 0.5 * (high - low)
    nodes = 0.5 * (high + low) + half * node
    return nodes.ravel(), (half * weight).ravel(), np.repeat(which, 16)


@functools.cache
def legendre(n: int) -> Any:
    """Nodes and weights of Gauss and Legendre's rule on [-1, 1]."""
    import numpy as np

    return np.polynomial.legendre.leggauss(n)
