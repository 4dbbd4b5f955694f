"""Blinn-Phong: a cosine power of the half vector.

f = ks N (n.h)^n  [1/sr]

Sampling: half vectors by their cosine power.
ks: 0 to 1.  n: exponent, 0 to 1e7.
norm: n+2 (N = (n+2)/(8 pi)), n+8 (N = (n+8)/(8 pi)), exact (N = (n+2)(n+4)/(8 pi (2^(-n/2) + n)),
albedo ks at the normal) or none (N = 1).
Source: Blinn 1977, "Models of light reflection for computer synthesized pictures"; n+8: Akenine-
Moller, Haines & Hoffman 2008, "Real-time rendering", eq. 7.47; exact: Giesen 2009.
Violates: energy conservation with n+8 for every n > 0 (1.075201 at the normal, n = 8.764), and with
none for n < 18.707. All darken as cos^2 towards grazing.
"""
from __future__ import annotations

import math

from montecarlo_brdf.models._half_lobe import pdf, sample
from montecarlo_brdf.models._microfacet import half_power, half_sums
from montecarlo_brdf.models.phong import Params, domain, scales_with, width
from montecarlo_brdf.special import exp2
from montecarlo_brdf.vectors import Vec

verified = [Params(), Params(n=0.0), Params(n=8.764), Params(n=1e4)]
lobe = ("half vector", lambda p: width(p.n))


def n_plus_2(p: Params) -> float:
    """(n+2)/(8 pi): albedo below 1 at every angle."""
    return (p.n + 2.0) / (8.0 * math.pi)


def n_plus_8(p: Params) -> float:
    """(n+8)/(8 pi): Akenine-Moller, Haines & Hoffman 2008, eq. 7.47."""
    return (p.n + 8.0) / (8.0 * math.pi)


def exact(p: Params) -> float:
    """(n+2)(n+4)/(8 pi (2^(-n/2) + n)): Giesen 2009."""
    return (p.n + 2.0) * (p.n + 4.0) / (8.0 * math.pi * (exp2(-0.5 * p.n) + p.n))


def none(p: Params) -> float:
    """N = 1: Blinn 1977, as published."""
    return 1.0


choices = {
    "norm": {
        "n+2": n_plus_2,
        "n+8": {
            "functions": {"norm": n_plus_8},
            "disclaims": {"energy": "reflects up to 1.075201 at the normal (n = 8.764)"},
        },
        "exact": exact,
        "none": none,
    }
}
norm = n_plus_2


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """ks N (n.h)^n."""
    return p.ks * norm(p) * half_power(half_sums(wo, wi), p.n)
