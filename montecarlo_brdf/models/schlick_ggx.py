"""GGX with Schlick's cheap masking, as game engines use it.

f = F D/(4 (mu_i (1-k) + k) (mu_o (1-k) + k))  [1/sr], F by Schlick, D of GGX

Sampling: visible normals of GGX.
alpha: GGX width, 1e-4 to 1.  f0: reflectance at normal incidence, 0 to 1.
k: direct (k = (sqrt(alpha) + 1)^2/8, for point lights) or ibl (k = alpha/2, for environments).
Source: Karis 2013, "Real shading in Unreal Engine 4", eqs. 3-4; Schlick 1994.
Conserves energy, but loses light: alpha = 0.05 with k = direct reflects 0.085 at 89 degrees.
"""
from __future__ import annotations

import math

from montecarlo_brdf.models._microfacet import ggx_density, half_sums, schlick
from montecarlo_brdf.models.ggx import Params, domain, lobe, pdf, sample
from montecarlo_brdf.vectors import Vec

verified = [Params(), Params(alpha=0.05), Params(alpha=1.0, f0=0.04)]


def direct(p: Params) -> float:
    """(sqrt(alpha) + 1)^2/8: Karis 2013, eq. 4, for point lights."""
    return (math.sqrt(p.alpha) + 1.0) ** 2 / 8.0


def ibl(p: Params) -> float:
    """alpha/2: Karis 2013, for environments."""
    return 0.5 * p.alpha


choices = {"k": {"direct": direct, "ibl": ibl}}
k = direct


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """F D G/(4 mu_i mu_o)."""
    h = half_sums(wo, wi)
    c = k(p)
    masking = (wi[2] * (1.0 - c) + c) * (wo[2] * (1.0 - c) + c)
    return 0.25 * schlick(h, p.f0) * ggx_density(h, p.alpha) / masking
