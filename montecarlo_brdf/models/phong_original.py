"""Phong 1975 as published: radiance of the highlight without the cosine of the light.

L_o = ks N max(0, r.v)^n L_i, so f = ks N max(0, r.v)^n/mu_i  [1/sr]

Sampling: cosine power around the mirror direction; below the horizon is rejected.
ks: 0 to 1.  n: exponent, 0 to 1e7.
norm: n+1 (N = (n+1)/(2 pi), albedo ks at the normal) or none (N = 1, as published).
Source: Phong 1975, "Illumination for computer generated pictures", CACM 18(6).
Violates: reciprocity, and energy conservation although the furnace test passes with n+1: light at
grazing is reflected more than it arrives, without bound as 1/mu_i (n = 1: 12.5 at 89 degrees).
Cosine-weighted estimates have infinite variance, because f grows as 1/mu_i.
"""
from __future__ import annotations

import math

from montecarlo_brdf.models.phong import (
    Params,
    domain,
    lobe,
    mirror_power,
    pdf,
    sample,
    scales_with,
)
from montecarlo_brdf.vectors import Vec

verified = [Params(), Params(n=1.0), Params(n=1e4)]
disclaims = {
    "reciprocity": "the division by mu_i is not symmetric",
    "energy": "grazing light is reflected without bound: R(89 degrees) = 12.5 for n = 1",
}


def n_plus_1(p: Params) -> float:
    """(n+1)/(2 pi): albedo ks at the normal."""
    return (p.n + 1.0) / (2.0 * math.pi)


def none(p: Params) -> float:
    """N = 1: Phong 1975, as published."""
    return 1.0


choices = {"norm": {"n+1": n_plus_1, "none": none}}
norm = n_plus_1


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """ks N (r.v)^n/mu_i."""
    return p.ks * norm(p) * mirror_power(wo, wi, p.n) / wi[2]
