"""Normal distributions in slope space, their exact Smith masking, other visibility terms; Fresnel.

P22(t) is the density of slopes (Beckmann & Spizzichino 1963; Trowbridge & Reitz 1975 = GGX;
Blinn 1977), D = P22/cos^4(theta_h), and Smith's Lambda follows by integration over the slopes that
face away (Heitz 2014, eq. 72); for Blinn-Phong that integral is an incomplete beta function, so
all three are exact. A masking below is G/(mu_i mu_o), which stays finite at the horizon. Fresnel's
reflectance is a function of x = h.v, in forms without cancellation.
"""

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from montecarlo_brdf.references._gamma import half_step
from montecarlo_brdf.references._kinks import TINY
from montecarlo_brdf.references._quadrature import Geometry
from montecarlo_brdf.references._rules import Array

BEYOND = 50.0  # ln of the decay at which a tail no longer counts: exp(-50) = 2e-22


class Distribution(NamedTuple):
    """A slope density P22(t), Smith's Lambda(mu), the scale of slopes and where they end."""

    p22: Callable[[Array], Array]
    lam: Callable[[Array], Array]
    alpha: float
    reach: float


def _sine_squared(mu: Array) -> Array:
    return np.maximum((1.0 - mu) * (1.0 + mu), TINY)


def _log_sine_squared(mu: Array) -> Array:
    """ln(1 - mu^2): a huge n multiplies the rounding of 1 - mu^2 where mu is small."""
    low = np.log1p(-(np.minimum(mu, 0.5) ** 2))
    return np.where(mu < 0.5, low, np.log(_sine_squared(mu)))


def ggx(alpha: float) -> Distribution:
    """Walter et al. 2007, eqs. 33-34."""

    rest = (1.0 - alpha) * (1.0 + alpha)

    def lam(mu: Array) -> Array:
        return 0.5 * np.sqrt(alpha * alpha + rest * mu * mu) / mu - 0.5

    return Distribution(lambda t: (alpha / (alpha**2 + t * t)) ** 2 / np.pi, lam, alpha, np.inf)


def beckmann(alpha: float) -> Distribution:
    """Walter et al. 2007, eqs. 25-26."""
    from scipy.special import erfc

    def lam(mu: Array) -> Array:
        a = mu / (alpha * np.sqrt(_sine_squared(mu)))
        tail: Array = erfc(a)
        return 0.5 * (np.exp(-a * a) / (a * math.sqrt(np.pi)) - tail)

    def p22(t: Array) -> Array:
        return np.exp(-((t / alpha) ** 2)) / (np.pi * alpha * alpha)

    return Distribution(p22, lam, alpha, alpha * math.sqrt(BEYOND))


@lru_cache(maxsize=64)
def _hidden(n: float) -> tuple[float, Array]:
    """Chebyshev series of I_{s^2}(n/2+1, 1/2) in z, mu = end (1 - z^4); it is 0 beyond mu = end.

    scipy's incomplete beta takes 3 us a value. Its (1 - mu)^(n/2+1) at the normal is smooth in z.
    """
    from scipy.special import betaincc

    end = math.sqrt(-math.expm1(-2.0 * BEYOND / (n + 2.0)))
    z = 0.5 + 0.5 * np.cos(np.pi * (np.arange(96) + 0.5) / 96)
    mu = end * (1.0 - z**4)
    return end, np.polynomial.chebyshev.chebfit(
        2.0 * z - 1.0, betaincc(0.5, 0.5 * n + 1, mu**2), 95
    )


def blinn_phong(n: float) -> Distribution:
    """Blinn 1977, normalised; Lambda derived from P22 and exact, unlike the usual Beckmann fit."""

    def lam(mu: Array) -> Array:
        end, series = _hidden(n)
        z = np.sqrt(np.sqrt(np.clip(1.0 - mu / end, 0.0, 1.0)))
        hidden = np.polynomial.chebyshev.chebval(2.0 * z - 1.0, series)
        scale = half_step(0.5 * n + 1.0) / (math.sqrt(np.pi) * (n + 1.0))
        facing = scale * np.exp((0.5 * n + 1.0) * _log_sine_squared(mu)) / mu
        return np.where(mu < end, facing - 0.5 * hidden, 0.0)

    def p22(t: Array) -> Array:
        return (n + 2.0) / (2.0 * np.pi) * np.exp(-(0.5 * n + 2.0) * np.log1p(t * t))

    reach = math.sqrt(math.expm1(min(2.0 * BEYOND / (n + 2.0), 100.0)))
    return Distribution(p22, lam, math.sqrt(2.0 / (n + 2.0)), reach)


def distribution(name: str, alpha: float | None = None, n: float | None = None) -> Distribution:
    width = n if name == "blinn_phong" else alpha
    if width is None:
        raise TypeError(f"{name} needs {'n' if name == 'blinn_phong' else 'alpha'}")
    return {"ggx": ggx, "beckmann": beckmann, "blinn_phong": blinn_phong}[name](width)


Visibility = Callable[[Geometry, Distribution], Array]


def smith(g: Geometry, d: Distribution) -> Array:
    """Height-correlated, Heitz 2014, eq. 99."""
    view = 1.0 + d.lam(np.asarray(g.mu_o))
    return 1.0 / ((view + d.lam(g.mu_i)) * (g.mu_o * g.mu_i))


def separable(g: Geometry, d: Distribution) -> Array:
    return 1.0 / ((1.0 + d.lam(g.mu_i)) * (1.0 + d.lam(np.asarray(g.mu_o))) * g.mu_i * g.mu_o)


def v_cavity(g: Geometry, d: Distribution) -> Array:
    """Torrance & Sparrow 1967; Cook & Torrance 1982, eq. 15."""
    groove = 2.0 * g.h_n * np.minimum(g.mu_i, g.mu_o) / g.h_v
    return np.minimum(1.0, groove) / (g.mu_i * g.mu_o)


def _walter_g1(mu: Array, alpha: float) -> Array:
    """Walter et al. 2007, eq. 27: a rational fit of Beckmann's G1, 1 from a = 1.6."""
    a = mu / (alpha * np.sqrt(_sine_squared(mu)))
    fit = (3.535 + 2.181 * a) * a / (1.0 + (2.276 + 2.577 * a) * a)
    return np.where(a < 1.6, fit, 1.0)


def walter(g: Geometry, d: Distribution) -> Array:
    both = _walter_g1(g.mu_i, d.alpha) * _walter_g1(np.asarray(g.mu_o), d.alpha)
    return both / (g.mu_i * g.mu_o)


def walter_correlated(g: Geometry, d: Distribution) -> Array:
    """Height-correlated with Lambda = 1/G1 - 1 of the fit."""
    o, i = _walter_g1(np.asarray(g.mu_o), d.alpha), _walter_g1(g.mu_i, d.alpha)
    return 1.0 / ((1.0 / o + 1.0 / i - 1.0) * g.mu_i * g.mu_o)


def walter_cosine(alpha: float) -> float:
    """The cosine at which the rational fit ends, with a small jump: a = 1.6."""
    return 1.6 * alpha / math.hypot(1.0, 1.6 * alpha)


def width_over_h_v(d: Distribution, mu_o: float) -> float:
    """The scale in slopes of D times a power of 1/(h.v), which grows like 1 + k t near grazing."""
    return min(d.alpha, mu_o)


def kelemen(g: Geometry, d: Distribution) -> Array:
    """Kelemen & Szirmay-Kalos 2001: G/(mu_i mu_o) = 1/(h.v)^2."""
    return 1.0 / g.h_v**2


def implicit(g: Geometry, d: Distribution) -> Array:
    return np.ones_like(g.mu_i)


def none(g: Geometry, d: Distribution) -> Array:
    return 1.0 / (g.mu_i * g.mu_o)


def schlick_k(g: Geometry, k: float) -> Array:
    """Schlick 1994 as used with GGX by Karis 2013: mu/(mu (1-k) + k) for either direction."""
    return 1.0 / ((g.mu_i * (1.0 - k) + k) * (g.mu_o * (1.0 - k) + k))


def schlick_k_direct(g: Geometry, d: Distribution) -> Array:
    return schlick_k(g, (math.sqrt(d.alpha) + 1.0) ** 2 / 8.0)


def schlick_k_ibl(g: Geometry, d: Distribution) -> Array:
    return schlick_k(g, 0.5 * d.alpha)


MASKINGS: dict[str, Visibility] = {
    "smith": smith,
    "separable": separable,
    "v_cavity": v_cavity,
    "walter": walter,
    "walter_correlated": walter_correlated,
    "kelemen": kelemen,
    "implicit": implicit,
    "none": none,
    "schlick_k_direct": schlick_k_direct,
    "schlick_k_ibl": schlick_k_ibl,
}


def schlick(x: Array, f0: float) -> Array:
    """Schlick 1994: f0 + (1 - f0)(1 - x)^5."""
    y = 1.0 - x
    square = y * y
    return f0 + (1.0 - f0) * (square * square * y)


def fresnel(x: Array, eta: float, k: float = 0.0) -> Array:
    """Exact unpolarised reflectance for the index m = eta + i k against 1.

    With g^2 = m^2 - 1 + x^2 the amplitudes (x-g)/(x+g) and (m^2 x-g)/(m^2 x+g) are rewritten so
    that m -> 1 costs no digits. Total internal reflection (eta < 1) comes out as exactly 1.
    """
    m = eta if k == 0.0 and eta >= 1.0 else complex(eta, k)
    m2, above_one = m * m, (m - 1.0) * (m + 1.0)
    g = np.sqrt(above_one + x * x)
    senkrecht = 1.0 / _norm(x + g) ** 2
    parallel = _norm(x * x * (m2 + 1.0) - 1.0) / _norm(m2 * x + g) ** 2
    return 0.5 * abs(above_one) ** 2 * (senkrecht + parallel)


def _norm(z: NDArray[np.inexact[Any]]) -> Array:
    """|z|^2 without the square root of abs."""
    return np.asarray(z.real**2 + z.imag**2 if np.iscomplexobj(z) else z * z)
