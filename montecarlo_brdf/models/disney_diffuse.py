"""Disney (Burley) diffuse: Schlick-like darkening or brightening towards grazing by roughness.

f = albedo/pi (1 + X (1 - mu_i)^5) (1 + X (1 - mu_o)^5)  [1/sr],
X = 2 roughness (h.v)^2 - 1/2

Sampling: cosine-weighted.
albedo: base colour, 0 to 1.  roughness: 0 to 1.
Source: Burley 2012, "Physically-based shading at Disney", section 5.3.
Violates: energy conservation: 785/504 = 1.557540 at grazing (roughness 1), at the normal for
roughness > 2/5, under uniform light for roughness > 0.427.
"""
from __future__ import annotations

import math

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.models._microfacet import half_sums
from montecarlo_brdf.models.fon import Params, domain
from montecarlo_brdf.vectors import Vec

verified = [Params(), Params(roughness=0.0), Params(roughness=1.0)]
disclaims = {"energy": "albedo 1 reflects up to 785/504 = 1.557540 at grazing (roughness 1)"}
scales_with = "albedo"


def fifth(mu: float) -> float:
    """(1 - mu)^5."""
    c = 1.0 - mu
    c2 = c * c
    return c2 * c2 * c


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """With (h.v)^2 = |wi + wo|^2/4."""
    x = 0.5 * p.roughness * half_sums(wo, wi)[2] - 0.5
    return p.albedo / math.pi * (1.0 + x * fifth(wi[2])) * (1.0 + x * fifth(wo[2]))
