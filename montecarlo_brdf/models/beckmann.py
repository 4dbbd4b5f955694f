"""Beckmann microfacets with height-correlated Smith masking and Schlick's Fresnel.

f = F(h.v) D(h) G/(4 mu_i mu_o)  [1/sr]
D = exp(-tan^2/alpha^2)/(pi alpha^2 (n.h)^4),  G = 1/(1 + Lambda_i + Lambda_o),
Lambda = (exp(-a^2)/(a sqrt(pi)) - erfc(a))/2,  a = 1/(alpha tan),  F = f0 + (1 - f0)(1 - h.v)^5

Sampling: visible normals of GGX with the same alpha: closed form, exact density, and as
D/D_ggx <= 4/e the weights stay bounded.
alpha: width of the slope distribution, 1e-4 to 1.
f0: reflectance at normal incidence, 0 to 1; 1 (default) means no Fresnel loss.
Source: Walter et al. 2007, "Microfacet models for refraction through rough surfaces", eqs. 25-26;
Heitz 2014, "Understanding the masking-shadowing function", eq. 99; Schlick 1994, eq. 15.
Conserves energy, but loses light at high roughness.
"""
from __future__ import annotations

from montecarlo_brdf.models._masking import smith
from montecarlo_brdf.models._microfacet import beckmann_density, half_sums, schlick
from montecarlo_brdf.models._smith import beckmann_hidden
from montecarlo_brdf.models.ggx import Params, domain, lobe, lossless, pdf, sample, verified
from montecarlo_brdf.vectors import Vec


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """F D G/(4 mu_i mu_o)."""
    h = half_sums(wo, wi)
    hidden = (beckmann_hidden(wo, p.alpha), beckmann_hidden(wi, p.alpha))
    masking = smith(h, (wo[2], wi[2]), hidden, p.alpha)
    return 0.25 * schlick(h, p.f0) * beckmann_density(h, p.alpha) * masking
