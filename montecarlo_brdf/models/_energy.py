"""The energy that height-correlated GGX loses, 1 - E(mu), as a table and how it is computed.

By the weak white furnace (Heitz 2014, "Understanding the masking-shadowing function"), 1 - E is an
integral of positive terms: light masked on its way out, and reflections below the horizon. The
azimuth integral of D (Walter et al. 2007, eq. 33) is elementary: `ring`. What is left is one
integral over the elevation, on panels that shrink towards the mirror direction, the horizon and the
normal.

The table keeps the digits of 1 - E itself, which is of the order of alpha^2 at steep angles and of
mu at the horizon. With x = mu/alpha and stretched = sqrt(mu^2 + alpha^2 (1 - mu^2)),

    1 - E = mu stretched ln(1 + 1/x^2)/2 + x/(1 + x)^3 P(x).

The first term is all there is of the logarithm at mu = 0: masking has a pole at mu_i = -mu, whose
residue is mu stretched. P stays between 0.2 and 3 for small alpha as for large, but where the first
term is by far the larger, and has branch points only near x = i and x = -i, which (1 + x)^(-1/4)
keeps away: a Chebyshev series of 48 terms in it gives 1 - E with relative error below 1e-10 for
alpha >= 1e-4.
"""
from __future__ import annotations

import functools
import math
from typing import TYPE_CHECKING, NamedTuple

from montecarlo_brdf.models._chebyshev import Eight, eight_terms, fitted
from montecarlo_brdf.special import log1p

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]

TERMS = 48
STEEPEST = 1e-18  # of x: below, 1/x^2 leaves single precision


class Table(NamedTuple):
    """GGX's parameters, the factor that a model wants, and the coefficients of P."""

    alpha: float
    f0: float
    factor: float
    k0: Eight
    k1: Eight
    k2: Eight
    k3: Eight
    k4: Eight
    k5: Eight


def lost(mu: float, p: Table) -> float:
    """1 - E(mu)."""
    x = mu / p.alpha
    q = 1.0 / (1.0 + x)
    least = least_root(p.alpha)
    t = 2.0 * (math.sqrt(math.sqrt(q)) - least) / (1.0 - least) - 1.0
    return x * (q * q * q * series(t, p) + p.alpha * p.alpha * logarithm(mu, x))


def logarithm(mu: float, x: float) -> float:
    """stretched/alpha ln(1 + 1/x^2)/2, x = mu/alpha."""
    held = max(x, STEEPEST)
    return 0.5 * math.sqrt((1.0 - mu) * (1.0 + mu) + x * x) * log1p(1.0 / (held * held))


def series(t: float, p: Table) -> float:
    """P by Clenshaw's recurrence."""
    b, c = eight_terms(p.k5, t, 0.0, 0.0)
    b, c = eight_terms(p.k4, t, b, c)
    b, c = eight_terms(p.k3, t, b, c)
    b, c = eight_terms(p.k2, t, b, c)
    b, c = eight_terms(p.k1, t, b, c)
    b, c = eight_terms(p.k0, t, b, c)
    return b - t * c


def least_root(alpha: float) -> float:
    """(1 + x)^(-1/4) at mu = 1."""
    return math.sqrt(math.sqrt(alpha / (1.0 + alpha)))


def table(alpha: float, f0: float) -> Table:
    """The table of one alpha."""
    return Table(alpha, f0, 1.0, *coefficients(alpha))


@functools.lru_cache(maxsize=1024)
def coefficients(alpha: float) -> tuple[Eight, ...]:
    """The series of one alpha, which takes some milliseconds to make."""
    return fitted(lambda t: smooth_part(cosine_at(t, alpha), alpha), TERMS)


def cosine_at(t: Array, alpha: float) -> Array:
    """The cosines that the table has at t in [-1, 1]."""
    import numpy as np

    least = least_root(alpha)
    away = (1.0 - least) * (0.5 - 0.5 * t)  # 1 - (1 + x)^(-1/4)
    return np.minimum(1.0, alpha * np.expm1(-4.0 * np.log1p(-away)))


def smooth_part(mu: Array, alpha: float) -> Array:
    """P."""
    import numpy as np

    x = mu / alpha
    stretched = np.sqrt((1.0 - mu) * (1.0 + mu) + x * x)
    logarithmic = 0.5 * alpha * alpha * stretched * np.log1p(1.0 / (x * x))
    return (1.0 + x) ** 3 * (lost_exactly(mu, alpha) / x - logarithmic)


@functools.lru_cache(maxsize=1024)
def average_lost(alpha: float) -> float:
    """2 integral of (1 - E) mu dmu, by Gauss-Legendre over z with 1 - (1 + x)^(-1/4) ~ z^2, in
    which the logarithm at the horizon does not sting."""
    import numpy as np

    nodes, weights = legendre(64)
    z = 0.5 + 0.5 * nodes
    away = 1.0 - least_root(alpha)
    slope = 8.0 * alpha * away * z / (1.0 - away * z * z) ** 5  # dmu/dz
    mu, made = cosine_at(1.0 - 2.0 * z * z, alpha), table(alpha, 1.0)
    missing = np.array([lost(m, made) for m in mu.tolist()])
    return float(np.sum(weights * mu * slope * missing))


def lost_exactly(mu: Array, alpha: float) -> Array:
    """1 - E at cosines mu by quadrature over the elevation of wi, down to where h meets the
    horizon. Elevations keep their digits at the horizon; at the normal alpha is what matters."""
    import numpy as np

    a2, cosines = alpha * alpha, np.atleast_1d(np.asarray(mu, dtype=float))
    elevations = np.arctan2(cosines, np.sqrt((1.0 - cosines) * (1.0 + cosines)))
    up, weight, which = panels(elevations, cosines, alpha)
    mu_o, up_o = cosines[which], elevations[which]
    mu_i, sine2 = np.abs(np.sin(up)), np.cos(up) ** 2
    stretched_i = np.sqrt(mu_i * mu_i + a2 * sine2)
    stretched_o = np.sqrt(mu_o * mu_o + a2 * (1.0 - mu_o) * (1.0 + mu_o))
    hidden = a2 * sine2 / (stretched_i + mu_i)
    masked = mu_o * hidden / (mu_i * stretched_o + mu_o * stretched_i)
    leaving = np.where(up > 0.0, masked, 1.0) / (mu_o + stretched_o)
    parts = 0.5 * weight * np.cos(up) * ring(up, up_o, a2) * leaving
    return np.bincount(which, parts, len(cosines)).reshape(np.shape(mu))  # type: ignore[return-value]


def ring(up_i: Array, up_o: Array, a2: float) -> Array:
    """Integral of D over the azimuth between wi and wo, of two elevations."""
    import numpy as np

    s, d = 0.5 * (up_i + up_o), 0.5 * (up_i - up_o)
    c2, cd2 = np.sin(s) ** 2, np.cos(d) ** 2
    near = np.sin(d) ** 2 + a2 * cd2
    far = 4.0 * cd2 * (np.cos(s) ** 2 + a2 * c2)
    k = cd2 * (1.0 - a2)
    x = near * far
    mean = 0.5 * (far + 4.0 * c2 * near)
    return 2.0 * a2 * (1.0 + np.sqrt(c2 / x) * k * (4.0 + 2.0 * k * mean / x))


def panels(up_o: Array, mu: Array, alpha: float) -> tuple[Array, Array, npt.NDArray[np.int64]]:
    """Gauss-Legendre nodes and weights on [-up_o, pi/2] of each elevation, and whose they are:
    panels double away from the peaks."""
    import numpy as np

    first = np.maximum(np.minimum(alpha, mu), 1e-18)[:, None]
    steps = first * 2.0 ** np.arange(1 + math.ceil(math.log2(math.pi / first.min())))
    moves = np.concatenate([-steps, 0.0 * first, steps], axis=1)
    lowest = -up_o[:, None]
    peaks = (0.0, -lowest, 0.5 * math.pi)
    cuts = np.concatenate([lowest, *(peak + moves for peak in peaks)], axis=1)
    cuts = np.sort(np.clip(cuts, lowest, 0.5 * math.pi), axis=1)
    which, place = np.nonzero(cuts[:, 1:] > cuts[:, :-1])
    low, high = cuts[which, place][:, None], cuts[which, place + 1][:, None]
    node, weight = legendre(16)
    half = 0.5 * (high - low)
    nodes = 0.5 * (high + low) + half * node
    return nodes.ravel(), (half * weight).ravel(), np.repeat(which, 16)


@functools.cache
def legendre(n: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss and Legendre's rule on [-1, 1]."""
    import numpy as np

    return np.polynomial.legendre.leggauss(n)
