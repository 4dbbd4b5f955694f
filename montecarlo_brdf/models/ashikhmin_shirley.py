"""Ashikhmin-Shirley, isotropic: a Phong-like lobe over a diffuse base that it shadows.

f = 28 rd/(23 pi) (1 - rs) (1 - (1 - mu_i/2)^5) (1 - (1 - mu_o/2)^5)
    + (n+1)/(8 pi) (n.h)^n F/((h.v) max(mu_i, mu_o))  [1/sr],  F = rs + (1 - rs)(1 - h.v)^5

Sampling: half cosine-weighted, half by half vectors.
rd, rs: diffuse and specular reflectance at normal incidence, 0 to 1.  n: exponent, 0 to 1e7.
Source: Ashikhmin & Shirley 2000, "An anisotropic Phong BRDF model", J. Graphics Tools 5(2),
eqs. 3-5 with n_u = n_v.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models import _half_lobe
from montecarlo_brdf.models._microfacet import half_power, half_sums, schlick
from montecarlo_brdf.models.phong import width
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    rd: float = 0.5
    rs: float = 0.5
    n: float = 32.0


domain = {"rd": (0.0, 1.0), "rs": (0.0, 1.0), "n": (0.0, 1e7)}
verified = [Params(), Params(rs=1.0), Params(rd=1.0, rs=0.04, n=1e4), Params(rs=0.0, n=0.0)]
lobe = ("half vector", lambda p: width(p.n))
kinks = ("mu_i=mu_o",)


def base(mu: float) -> float:
    """1 - (1 - mu/2)^5, expanded so that nothing cancels at grazing."""
    x = 0.5 * mu
    return x * (5.0 + x * (-10.0 + x * (10.0 + x * (-5.0 + x))))


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """Diffuse base and lobe."""
    h = half_sums(wo, wi)
    diffuse = 28.0 / (23.0 * math.pi) * p.rd * (1.0 - p.rs) * base(wi[2]) * base(wo[2])
    shine = (p.n + 1.0) / (4.0 * math.pi) * half_power(h, p.n) * schlick(h, p.rs)
    return diffuse + shine / (math.sqrt(h[2]) * max(wi[2], wo[2]))


def sample(wo: Vec, u: Vec, p: Params) -> Vec:
    """One of the two, chosen by u[2]."""
    if u[2] < 0.5:
        return _half_lobe.sample(wo, u, p)
    return random_hemisphere_cosine(u[0], u[1])


def pdf(wo: Vec, wi: Vec, p: Params) -> float:
    """The density of the mixture."""
    return 0.5 * _half_lobe.pdf(wo, wi, p) + 0.5 * wi[2] / math.pi
