"""Oren-Nayar, qualitative: rough diffuse surface of V-shaped grooves, the form in common use.

f = albedo/pi (A + B max(0, cos(phi_i - phi_o)) sin a tan b)  [1/sr]
A = 1 - sigma^2/(2 (sigma^2 + 0.33)),  B = 0.45 sigma^2/(sigma^2 + 0.09),
a, b the larger and the smaller polar angle

Sampling: cosine-weighted.
albedo: of the facets, 0 to 1.  sigma: standard deviation of the facets' slope angle, radians,
0 to pi/2; 0 is Lambert.
Source: Oren & Nayar 1994, "Generalization of Lambert's reflectance model", eq. 30.
Violates: energy conservation for albedo > 0.98505: 1.015179 at grazing, sigma = 0.1985.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    albedo: float = 0.8
    sigma: float = 0.35


domain = {"albedo": (0.0, 1.0), "sigma": (0.0, math.pi / 2.0)}
verified = [Params(), Params(sigma=0.0), Params(albedo=0.5, sigma=1.2)]
limits = [({"sigma": 0.0}, "lambert")]
disclaims = {"energy": "albedo 1 reflects up to 1.015179 at grazing (sigma = 0.1985)"}
scales_with = "albedo"
kinks = ("mu_i=mu_o", "cos_phi=0")


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """With sin a tan b = sin_i sin_o/max(mu_i, mu_o) and x.x' = sin_i sin_o cos(phi_i - phi_o)."""
    s2 = p.sigma * p.sigma
    a = 1.0 - 0.5 * s2 / (s2 + 0.33)
    b = 0.45 * s2 / (s2 + 0.09)
    tangential = wi[0] * wo[0] + wi[1] * wo[1]
    return p.albedo / math.pi * (a + b * max(0.0, tangential) / max(wi[2], wo[2]))
