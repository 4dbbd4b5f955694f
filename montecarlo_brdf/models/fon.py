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
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    albedo: float = 0.8
    roughness: float = 0.5


domain = {"albedo": (0.0, 1.0), "roughness": (0.0, 1.0)}
verified = [Params(), Params(albedo=1.0, roughness=1.0), Params(roughness=0.0)]
limits = [({"roughness": 0.0}, "lambert")]
scales_with = "albedo"
kinks = ("mu_i=mu_o", "cos_phi=0")


def tangential_ratio(wo: Vec, wi: Vec) -> float:
    """s/t with s = sin_i sin_o cos(dphi), t = max(mu_i, mu_o) if s > 0 else 1.

    s is clamped to its range: rounded below -1 it would make f negative where f is 0.
    """
    s = max(-1.0, wi[0] * wo[0] + wi[1] * wo[1])
    return s / max(wi[2], wo[2]) if s > 0.0 else s


def fon_scale(roughness: float) -> float:
    """A = 1/(1 + (1/2 - 2/(3 pi)) roughness), which makes the albedo 1 at grazing."""
    return 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * math.pi)) * roughness)


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """albedo/pi A (1 + roughness s/t)."""
    shape = 1.0 + p.roughness * tangential_ratio(wo, wi)
    return p.albedo / math.pi * fon_scale(p.roughness) * shape
