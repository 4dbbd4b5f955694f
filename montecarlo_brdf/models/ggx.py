"""GGX (Trowbridge-Reitz) microfacets with height-correlated Smith masking and Schlick's Fresnel.

f = F(h.v) D(h) G/(4 mu_i mu_o)  [1/sr]
D = alpha^2/(pi ((n.h)^2 (alpha^2 - 1) + 1)^2),  G = 1/(1 + Lambda_i + Lambda_o),
Lambda = (sqrt(1 + alpha^2 tan^2) - 1)/2,  F = f0 + (1 - f0)(1 - h.v)^5

Sampling: visible normals.
alpha: roughness as width of the slope distribution, 1e-4 to 1.
f0: reflectance at normal incidence, 0 to 1; 1 (default) means no Fresnel loss.
Source: Walter et al. 2007, "Microfacet models for refraction through rough surfaces", eqs. 33-34;
Heitz 2014, "Understanding the masking-shadowing function", eq. 99; Schlick 1994, eq. 15.
Conserves energy, but loses light at high roughness: alpha = 1 reflects 0.31 at the normal.
"""
from __future__ import annotations

from typing import NamedTuple

from montecarlo_brdf.models._microfacet import (
    Facets,
    ggx_density,
    ggx_reflection,
    half_sums,
    sample_visible,
    schlick,
    stretched,
)
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    alpha: float = 0.3
    f0: float = 1.0


domain = {"alpha": (1e-4, 1.0), "f0": (0.0, 1.0)}
verified = [Params(), Params(alpha=0.05), Params(alpha=1.0), Params(alpha=0.001, f0=0.04)]
lossless = [Params(alpha=1e-4)]  # a mirror
lobe = ("half vector", lambda p: p.alpha)


def f(wo: Vec, wi: Vec, p: Facets) -> float:
    """F D G/(4 mu_i mu_o)."""
    h = half_sums(wo, wi)
    return schlick(h, p.f0) * ggx_reflection(h, wo, wi, p.alpha)


def sample(wo: Vec, u: Vec, p: Facets) -> Vec:
    """Reflection by a visible normal."""
    return sample_visible(wo, u, p.alpha, p.alpha)


def pdf(wo: Vec, wi: Vec, p: Facets) -> float:
    """G1(wo) D/(4 mu_o)."""
    d = ggx_density(half_sums(wo, wi), p.alpha)
    return 0.5 * d / (wo[2] + stretched(wo, p.alpha))
