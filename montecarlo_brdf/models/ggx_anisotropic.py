"""GGX with two roughnesses, height-correlated Smith masking and Schlick's Fresnel.

f = F(h.v) D(h)/(2 (mu_i S_o + mu_o S_i))  [1/sr],
D = 1/(pi alpha_x alpha_y ((h_x/alpha_x)^2 + (h_y/alpha_y)^2 + h_z^2)^2),
S = sqrt((alpha_x w_x)^2 + (alpha_y w_y)^2 + w_z^2)

Sampling: visible normals.
alpha_x, alpha_y: widths along x and y, 1e-4 to 1.  f0: reflectance at the normal, 0 to 1.
Source: Heitz 2014, "Understanding the masking-shadowing function", eqs. 85-87, 99;
Burley 2012, "Physically-based shading at Disney", eq. 13.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._microfacet import half_sums, sample_visible, schlick
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    alpha_x: float = 0.2
    alpha_y: float = 0.4
    f0: float = 1.0


domain = {"alpha_x": (1e-4, 1.0), "alpha_y": (1e-4, 1.0), "f0": (0.0, 1.0)}
verified = [Params(), Params(alpha_x=0.05, alpha_y=0.5), Params(alpha_x=1.0, alpha_y=0.02, f0=0.04)]
limits = [({"alpha_x": 0.3, "alpha_y": 0.3}, "ggx")]
lossless = [Params(alpha_x=1e-4, alpha_y=1e-4)]  # a mirror
isotropic = False
lobe = ("half vector", lambda p: min(p.alpha_x, p.alpha_y))


def density(wo: Vec, wi: Vec, p: Params) -> float:
    """D of the half vector of wo and wi."""
    x, y, z = (wi[0] + wo[0]) / p.alpha_x, (wi[1] + wo[1]) / p.alpha_y, wi[2] + wo[2]
    q = half_sums(wo, wi)[2] / (x * x + y * y + z * z)
    return q * q / (math.pi * p.alpha_x * p.alpha_y)


def stretched(w: Vec, p: Params) -> float:
    """S, in terms of which Lambda = (S/cos - 1)/2."""
    x, y = p.alpha_x * w[0], p.alpha_y * w[1]
    return math.sqrt(x * x + y * y + w[2] * w[2])


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """F D G/(4 mu_i mu_o)."""
    visible = 0.5 / (wi[2] * stretched(wo, p) + wo[2] * stretched(wi, p))
    return schlick(half_sums(wo, wi), p.f0) * density(wo, wi, p) * visible


def sample(wo: Vec, u: Vec, p: Params) -> Vec:
    """Reflection by a visible normal."""
    return sample_visible(wo, u, p.alpha_x, p.alpha_y)


def pdf(wo: Vec, wi: Vec, p: Params) -> float:
    """G1(wo) D/(4 mu_o)."""
    return 0.5 * density(wo, wi, p) / (wo[2] + stretched(wo, p))
