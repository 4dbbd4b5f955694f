"""Modified Phong with a diffuse part (Lafortune & Willems 1994).

f = kd/pi + ks (n+2)/(2 pi) max(0, r.v)^n  [1/sr]

Sampling: cosine-weighted or around the mirror direction, in proportion kd : ks.
kd, ks: diffuse albedo and albedo of the lobe at the normal, 0 to 1, together at most 1.
n: exponent, 0 to 1e7.
Source: Lafortune & Willems 1994, "Using the modified Phong reflectance model for physically based
rendering", eq. 1.
Violates: energy conservation at the normal for kd + ks > 1.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models import phong
from montecarlo_brdf.models.phong import lobe
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    kd: float = 0.4
    ks: float = 0.6
    n: float = 32.0


domain = {"kd": (0.0, 1.0), **phong.domain}
# kd and ks stay as they are: a search over both would leave kd + ks <= 1
verified = [Params(), Params(n=1.5), Params(n=1e4)]


def share(p: Params) -> float:
    """Fraction of samples that go to the lobe; half if nothing is reflected at all."""
    return (p.ks + 1e-30) / (p.kd + p.ks + 2e-30)


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """kd/pi + ks (n+2)/(2 pi) (r.v)^n."""
    shine = phong.f(wo, wi, p)
    return p.kd / math.pi + shine


def sample(wo: Vec, u: Vec, p: Params) -> Vec:
    """One of the two, chosen by u[2]."""
    if u[2] < share(p):
        return phong.sample(wo, u, p)
    return random_hemisphere_cosine(u[0], u[1])


def pdf(wo: Vec, wi: Vec, p: Params) -> float:
    """The density of the mixture."""
    w = share(p)
    return w * phong.pdf(wo, wi, p) + (1.0 - w) * wi[2] / math.pi
