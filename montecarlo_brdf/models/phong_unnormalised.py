"""Phong's lobe used as a BRDF as it stands, without normalisation.

f = ks max(0, r.v)^n  [1/sr]

Sampling: cosine power around the mirror direction; below the horizon is rejected.
ks: value at the mirror direction, 0 to 1.  n: exponent, 0 to 1e7.
Source: common use of Phong 1975, "Illumination for computer generated pictures".
Violates: energy conservation for n < 2 pi - 2 = 4.2832 (ks = 1): the albedo at the normal is
2 pi ks/(n+2). Large exponents lose nearly all light instead.
"""
from __future__ import annotations

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

verified = [Params(), Params(n=10.0), Params(n=1e4)]


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """ks (r.v)^n."""
    return p.ks * mirror_power(wo, wi, p.n)
