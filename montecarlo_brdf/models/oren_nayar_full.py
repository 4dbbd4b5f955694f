"""Oren-Nayar, full: direct light and one interreflection in V-shaped grooves.

f = albedo/pi [A + cos(dphi) C2 tan b + (1 - |cos(dphi)|) C3 tan((a+b)/2)]
    + 0.17 albedo^2/pi sigma^2/(sigma^2 + 0.13) [1 - cos(dphi) (2b/pi)^2]  [1/sr]
A = 1 - sigma^2/(2 (sigma^2 + 0.33)),  B = 0.45 sigma^2/(sigma^2 + 0.09),
C2 = B sin a where cos(dphi) >= 0, else B (sin a - (2b/pi)^3),
C3 = 0.125 sigma^2/(sigma^2 + 0.09) (4ab/pi^2)^2,  a, b the larger and the smaller polar angle

Sampling: cosine-weighted.
albedo: of the facets, 0 to 1.  sigma: standard deviation of the facets' slope angle, radians,
0 to pi/2; 0 is Lambert.
Source: Oren & Nayar 1994, "Generalization of Lambert's reflectance model", eqs. 27-29.
Violates: energy conservation (up to 1.051019 at grazing, sigma = 0.3044; safe for albedo below
0.95439) and positivity (pi f/albedo down to -0.25 at sigma = pi/2, both directions grazing).
"""
from __future__ import annotations

import math

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.models.oren_nayar import Params, domain, kinks, limits
from montecarlo_brdf.special import polar_angle
from montecarlo_brdf.vectors import Vec

TINY = 1e-300  # keeps 0/0 at the normal from happening; the azimuth there does not matter
verified = [Params(), Params(sigma=0.0), Params(albedo=0.05, sigma=0.5 * math.pi)]
disclaims = {
    "energy": "albedo 1 reflects up to 1.051019 at grazing (sigma = 0.3044)",
    "positivity": "pi f/albedo falls to -0.25 where both directions graze (sigma = pi/2, albedo 0)",
}


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """Direct light and one interreflection."""
    s2 = p.sigma * p.sigma
    a = 1.0 - 0.5 * s2 / (s2 + 0.33)
    once = a + direct(wo, wi, 0.45 * s2 / (s2 + 0.09), 0.125 * s2 / (s2 + 0.09))
    twice = 0.17 * p.albedo * s2 / (s2 + 0.13) * interreflected(wo, wi)
    return p.albedo / math.pi * (once + twice)


def sine(w: Vec) -> float:
    return math.sqrt(w[0] * w[0] + w[1] * w[1])


def cos_azimuth(wo: Vec, wi: Vec) -> float:
    """cos(phi_i - phi_o), clamped because the rounded quotient can pass 1."""
    c = (wi[0] * wo[0] + wi[1] * wo[1]) / max(sine(wi) * sine(wo), TINY)
    return max(-1.0, min(1.0, c))


def turned_low(wo: Vec, wi: Vec) -> tuple[float, float]:
    """(2 a/pi, 2 b/pi) of the larger and the smaller polar angle."""
    i = 2.0 / math.pi * polar_angle(sine(wi), wi[2])
    o = 2.0 / math.pi * polar_angle(sine(wo), wo[2])
    return max(i, o), min(i, o)


def direct(wo: Vec, wi: Vec, b: float, c3: float) -> float:
    """The terms of C2 and C3."""
    s_i, s_o = sine(wi), sine(wo)
    c = cos_azimuth(wo, wi)
    high, low = turned_low(wo, wi)
    steep = max(wi[2], wo[2])  # the cosine of the smaller angle
    c2 = b * (risen(wo, wi) if c < 0.0 else max(s_i, s_o))
    product = high * low
    middle = (s_i + s_o) / (wi[2] + wo[2])  # tan((a + b)/2)
    return c * c2 * min(s_i, s_o) / steep + across(wo, wi, c) * c3 * product * product * middle


def risen(wo: Vec, wi: Vec) -> float:
    """sin a - (2b/pi)^3, as (1 - (2b/pi)^3) - (1 - sin a): both vanish where tan b has its pole."""
    steep, flat = max(wi[2], wo[2]), min(wi[2], wo[2])
    s_steep, s_flat = min(sine(wi), sine(wo)), max(sine(wi), sine(wo))
    up = 2.0 / math.pi * polar_angle(steep, s_steep)  # 1 - 2b/pi
    low = 1.0 - up
    return up * (1.0 + low + low * low) - flat * flat / (1.0 + s_flat)


def across(wo: Vec, wi: Vec, c: float) -> float:
    """1 - |cos(dphi)| by the sine, which keeps its digits where the cosine is near 1."""
    s = (wi[0] * wo[1] - wi[1] * wo[0]) / max(sine(wi) * sine(wo), TINY)
    return min(1.0, s * s / (1.0 + abs(c)))


def interreflected(wo: Vec, wi: Vec) -> float:
    """1 - cos(dphi) (2b/pi)^2."""
    _, low = turned_low(wo, wi)
    return 1.0 - cos_azimuth(wo, wi) * low * low
