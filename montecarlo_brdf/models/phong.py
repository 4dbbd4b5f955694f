"""Phong, modified: a reciprocal cosine lobe around the mirror direction, normalised.

f = ks (n+2)/(2 pi) max(0, r.v)^n  [1/sr]

Sampling: cosine power around the mirror direction; below the horizon is rejected.
ks: albedo at the normal, 0 to 1.  n: exponent, 0 to 1e7, need not be whole.
Source: Lafortune & Willems 1994, "Using the modified Phong reflectance model for physically based
rendering", eq. 1; Phong 1975 for the lobe.
Conserves energy for ks <= 1: the albedo falls from ks at the normal towards grazing.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._mirror_lobe import (
    Shine,
    mirror_power,
    mirror_power_pdf,
    sample_mirror_power,
    width,
)
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    ks: float = 1.0
    n: float = 32.0


domain = {"ks": (0.0, 1.0), "n": (0.0, 1e7)}
verified = [Params(), Params(n=0.0), Params(n=2.5), Params(n=1e4)]
scales_with = "ks"
lobe = ("mirror", lambda p: width(p.n))


def f(wo: Vec, wi: Vec, p: Shine) -> float:
    """ks (n+2)/(2 pi) (r.v)^n."""
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * mirror_power(wo, wi, p.n)


def sample(wo: Vec, u: Vec, p: Shine) -> Vec:
    """Cosine power around the mirror direction."""
    return sample_mirror_power(wo, u, p.n)


def pdf(wo: Vec, wi: Vec, p: Shine) -> float:
    """(n+1)/(2 pi) (r.v)^n."""
    return mirror_power_pdf(wo, wi, p.n)
