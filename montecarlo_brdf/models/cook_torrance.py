"""Microfacet models put together from parts: distribution, masking, Fresnel, normalisation.

f = F(h.v) D(h) G/(N mu_i mu_o)  [1/sr],  N = 4, or pi as Cook & Torrance have it

Sampling: visible normals of GGX with the same width; the tails of the other distributions are
lighter, so weights stay bounded (Beckmann: D/D_ggx <= 4/e).
distribution: ggx, beckmann (width alpha, 1e-4 to 1) or blinn_phong (exponent n, 0 to 1e7, which is
like alpha = sqrt(2/(n+2))).
masking: smith (height-correlated) and separable, both with the exact Lambda of the distribution;
v_cavity; walter and walter_correlated (rational fit of Beckmann's G1, separable and
height-correlated); kelemen (G = mu_i mu_o/(h.v)^2); implicit (G = mu_i mu_o); none;
schlick_k_direct and schlick_k_ibl.
fresnel: one, schlick (f0), dielectric (eta >= 1), conductor (eta, k).
Source: Cook & Torrance 1982; Walter et al. 2007; Heitz 2014; Kelemen & Szirmay-Kalos 2001; Schlick
1994; Karis 2013. Blinn-Phong's exact Lambda: the integral of Heitz 2014, eq. 72.
Violates: energy conservation without masking (without bound at grazing), with walter for
blinn_phong (1.25 at grazing, n = 1; 1.38 with walter_correlated), and when divided by pi
(4/pi = 1.273 for smooth surfaces).
"""
from __future__ import annotations

import math
from typing import Any, NamedTuple

from montecarlo_brdf.models import _masking
from montecarlo_brdf.models._chebyshev import Eight
from montecarlo_brdf.models._fresnel import conductor, dielectric
from montecarlo_brdf.models._microfacet import (
    beckmann_density,
    ggx_density,
    half_power,
    half_sums,
    schlick,
    stretched,
)
from montecarlo_brdf.models._smith import beckmann_hidden, blinn_phong_hidden, blinn_phong_series
from montecarlo_brdf.models.ggx import pdf, sample
from montecarlo_brdf.models.phong import width
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    """Every parameter comes with the parts picked."""


class Prepared(NamedTuple):
    alpha: float  # width of the distribution
    fresnel0: float  # what the Fresnel part needs
    fresnel1: float


class PreparedBlinnPhong(NamedTuple):
    alpha: float
    fresnel0: float
    fresnel1: float
    n: float
    c: float  # from here on as in `_smith.Series`
    end: float
    scale: float
    low: Eight
    middle: Eight
    high: Eight


def ggx(h: Vec, p: Prepared) -> float:
    """Trowbridge & Reitz 1975; Walter et al. 2007, eq. 33."""
    return ggx_density(h, p.alpha)


def hidden_by_ggx(w: Vec, p: Prepared) -> float:
    side2 = w[0] * w[0] + w[1] * w[1]
    return 0.5 * p.alpha * p.alpha * side2 / (stretched(w, p.alpha) + w[2])


def beckmann(h: Vec, p: Prepared) -> float:
    """Beckmann & Spizzichino 1963; Walter et al. 2007, eq. 25."""
    return beckmann_density(h, p.alpha)


def hidden_by_beckmann(w: Vec, p: Prepared) -> float:
    return beckmann_hidden(w, p.alpha)


def blinn_phong(h: Vec, p: PreparedBlinnPhong) -> float:
    """Blinn 1977, normalised: Walter et al. 2007, eq. 30."""
    return (p.n + 2.0) / (2.0 * math.pi) * half_power(h, p.n)


def with_alpha(p: Any, optics: tuple[float, float]) -> Prepared:
    return Prepared(p.alpha, *optics)


def with_exponent(p: Any, optics: tuple[float, float]) -> PreparedBlinnPhong:
    series: Any = blinn_phong_series(p.n)
    return PreparedBlinnPhong(width(p.n), *optics, *series)


def one(h: Vec, p: Prepared) -> float:
    """Everything is reflected."""
    return 1.0


def schlick_f0(h: Vec, p: Prepared) -> float:
    """f0 + (1 - f0)(1 - h.v)^5: Schlick 1994, eq. 15."""
    return schlick(h, p.fresnel0)


def real_index(h: Vec, p: Prepared) -> float:
    """Exact for a real index: Born & Wolf, section 1.5.2."""
    return dielectric(0.5 * math.sqrt(h[2]), p.fresnel0)


def complex_index(h: Vec, p: Prepared) -> float:
    """Exact for an index eta + i k: Born & Wolf, section 14.2."""
    return conductor(0.5 * math.sqrt(h[2]), p.fresnel0, p.fresnel1)


def by_four() -> float:
    """Torrance & Sparrow 1967; Walter et al. 2007, eq. 20."""
    return 4.0


def by_pi() -> float:
    """Cook & Torrance 1982, as it is usually quoted."""
    return math.pi


ALPHA = {"params": {"alpha": 0.3}, "domain": {"alpha": (1e-4, 1.0)}}
choices = {
    "distribution": {
        "ggx": {
            "functions": {"density": ggx, "hidden": hidden_by_ggx, "shape": with_alpha},
            **ALPHA,
        },
        "beckmann": {
            "functions": {"density": beckmann, "hidden": hidden_by_beckmann, "shape": with_alpha},
            **ALPHA,
        },
        "blinn_phong": {
            "functions": {
                "density": blinn_phong,
                "hidden": blinn_phong_hidden,
                "shape": with_exponent,
            },
            "params": {"n": 32.0},
            "domain": {"n": (0.0, 1e7)},
        },
    },
    "masking": {
        "smith": _masking.smith,
        "separable": _masking.separable,
        "v_cavity": _masking.v_cavity,
        "walter": _masking.walter,
        "walter_correlated": _masking.walter_correlated,
        "kelemen": _masking.kelemen,
        "implicit": _masking.implicit,
        "none": {
            "functions": {"masking": _masking.none},
            "disclaims": {"energy": "reflects without bound at grazing"},
        },
        "schlick_k_direct": _masking.schlick_k_direct,
        "schlick_k_ibl": _masking.schlick_k_ibl,
    },
    "fresnel": {
        "one": {"functions": {"fresnel": one, "optics": lambda p: (0.0, 0.0)}},
        "schlick": {
            "functions": {"fresnel": schlick_f0, "optics": lambda p: (p.f0, 0.0)},
            "params": {"f0": 1.0},
            "domain": {"f0": (0.0, 1.0)},
        },
        "dielectric": {
            "functions": {"fresnel": real_index, "optics": lambda p: (p.eta, 0.0)},
            "params": {"eta": 1.5},
            "domain": {"eta": (1.0, 10.0)},
        },
        "conductor": {
            "functions": {"fresnel": complex_index, "optics": lambda p: (p.eta, p.k)},
            "params": {"eta": 0.2, "k": 3.9},
            "domain": {"eta": (0.01, 10.0), "k": (0.0, 20.0)},
        },
    },
    "normalisation": {"4": by_four, "pi": by_pi},
}
density, hidden, shape, masking = ggx, hidden_by_ggx, with_alpha, _masking.smith
fresnel, normalisation = one, by_four
optics: Any = None
lobe = ("half vector", lambda p: p.alpha if "alpha" in p._fields else width(p.n))


def prepare(p: Params) -> Prepared:
    """The numbers that the parts picked need."""
    return shape(p, optics(p))


def f(wo: Vec, wi: Vec, p: Prepared) -> float:
    """F D G/(N mu_i mu_o)."""
    h = half_sums(wo, wi)
    visible = masking(h, (wo[2], wi[2]), (hidden(wo, p), hidden(wi, p)), p.alpha)
    return fresnel(h, p) * density(h, p) * visible / normalisation()
