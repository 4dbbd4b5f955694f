"""EON: Fujii's Oren-Nayar with the light it loses given back by multiple scattering.

f = f_ss + f_ms  [1/sr],  f_ss = FON,
f_ms = albedo_ms/pi (1 - E(mu_i)) (1 - E(mu_o))/(1 - E_avg),
albedo_ms = albedo^2 E_avg/(1 - albedo (1 - E_avg)),  E = albedo of FON with albedo 1

Sampling: cosine-weighted.
albedo: of the facets, 0 to 1; albedo 1 reflects everything.  roughness: 0 (Lambert) to 1.
Source: Portsmouth, Kutz & Hill 2025, "EON: a practical energy-preserving rough diffuse BRDF",
JCGT 14(1), with the exact directional albedo instead of its fit.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.models.fon import (
    Params,
    domain,
    fon_scale,
    kinks,
    limits,
    tangential_ratio,
    verified,
)
from montecarlo_brdf.special import polar_angle
from montecarlo_brdf.vectors import Vec

G_GRAZING = 0.5 * math.pi - 2.0 / 3.0
AVERAGE_MISSING = 6.0 / (5.0 * math.pi) - 1.0 / 6.0
lossless = [Params(albedo=1.0, roughness=r) for r in (0.0, 0.5, 1.0)]


class Prepared(NamedTuple):
    single: float
    roughness: float
    multiple: float


def prepare(p: Params) -> Prepared:
    """1 - E = A r/pi missing(theta): the factor r cancels, so that r = 0 is no 0/0."""
    a = fon_scale(p.roughness)
    lost = a * p.roughness * AVERAGE_MISSING
    albedo_ms = p.albedo * p.albedo * (1.0 - lost) / (1.0 - p.albedo * lost)
    multiple = albedo_ms / math.pi * a * p.roughness / (math.pi * math.pi * AVERAGE_MISSING)
    return Prepared(p.albedo / math.pi * a, p.roughness, multiple)


def missing(w: Vec) -> float:
    """G(pi/2) - G(theta), to which the light that FON loses is proportional.

    With gamma = pi/2 - theta and mu = sin(gamma) every term vanishes at grazing, so it keeps its
    digits there, where G(pi/2) - G would cancel.
    """
    mu = w[2]
    s = math.sqrt(w[0] * w[0] + w[1] * w[1])
    q = 1.0 / (1.0 + s)
    dip = G_GRAZING * mu * mu * q + s * s * mu + s * polar_angle(mu, s)
    return dip - 2.0 / 3.0 * s * mu * (1.0 + s + s * s) * q


def f(wo: Vec, wi: Vec, p: Prepared) -> float:
    """f_ss + f_ms."""
    single = p.single * (1.0 + p.roughness * tangential_ratio(wo, wi))
    return single + p.multiple * missing(wi) * missing(wo)
