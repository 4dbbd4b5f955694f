"""FON: Fujii's Oren-Nayar, normalised to never reflect more than it receives.

f = albedo/pi A (1 + roughness s/t)  [1/sr]
A = 1/(1 + (1/2 - 2/(3 pi)) roughness),  s = wi.wo - mu_i mu_o,
t = max(mu_i, mu_o) if s > 0 else 1

Sampling: cosine-weighted.
albedo: of the facets, 0 to 1.  roughness: 0 (Lambert) to 1.
Source: Fujii's footnote; Portsmouth, Kutz & Hill 2025, "EON: a practical energy-preserving rough
diffuse BRDF", JCGT 14(1).
Conserves energy, but loses light: albedo 1, roughness 1 reflects 0.7765 at the normal.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.models._rough_diffuse import fon_scale, tangential_ratio
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    albedo: float = 0.8
    roughness: float = 0.5


domain = {"albedo": (0.0, 1.0), "roughness": (0.0, 1.0)}
verified = [Params(), Params(albedo=1.0, roughness=1.0), Params(roughness=0.0)]
limits = [({"roughness": 0.0}, "lambert")]
scales_with = "albedo"
kinks = ("mu_i=mu_o", "cos_phi=0")


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """albedo/pi A (1 + roughness s/t)."""
    shape = 1.0 + p.roughness * tangential_ratio(wo, wi)
    return p.albedo / math.pi * fon_scale(p.roughness) * shape
