"""Minnaert: a lunar surface that darkens (k > 1) or brightens (k < 1) towards the limb.

f = albedo/pi (mu_i mu_o)^(k-1)  [1/sr]

Sampling: density proportional to mu_i^k, which leaves no variance.
albedo: 0 to 1; the reflected fraction is 2 albedo mu_o^(k-1)/(k+1).
k: -0.45 to 4; 1 is Lambert. Below 0 cosine sampling has infinite variance, below -1/2 uniform
sampling too.
Source: Minnaert 1941, "The reciprocity principle in lunar photometry", Astrophys. J. 93.
Violates: energy conservation at grazing for every k < 1 (the albedo grows without bound), and for
k > 1 only where albedo > (k+1)/2, which is outside the domain.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.special import expm1, log1p, power, turn
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    albedo: float = 0.8
    k: float = 1.5


domain = {"albedo": (0.0, 1.0), "k": (-0.45, 4.0)}
verified = [Params(), Params(k=1.0), Params(k=0.5), Params(k=3.0)]
limits = [({"k": 1.0}, "lambert")]
disclaims = {"energy": "k < 1 reflects without bound at grazing: 26.17 at 89 degrees for k = 0.3"}
scales_with = "albedo"


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """albedo/pi (mu_i mu_o)^(k-1)."""
    return p.albedo / math.pi * power(wi[2] * wo[2], p.k - 1.0)


def sample(wo: Vec, u: Vec, p: Params) -> Vec:
    """mu = (1 - u)^(1/(k+1)), and sin^2 = 1 - mu^2 without cancellation."""
    sine = math.sqrt(-expm1(2.0 / (p.k + 1.0) * log1p(-u[0])))
    c, s = turn(u[1])
    return sine * c, sine * s, power(1.0 - u[0], 1.0 / (p.k + 1.0))


def pdf(wo: Vec, wi: Vec, p: Params) -> float:
    """(k+1)/(2 pi) mu_i^k."""
    return (p.k + 1.0) / (2.0 * math.pi) * power(wi[2], p.k)
