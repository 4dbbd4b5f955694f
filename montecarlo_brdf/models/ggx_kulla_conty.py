"""GGX with the energy that masking loses given back by a diffuse-like term (Kulla & Conty 2017).

f = f_ss + k (1 - E(mu_i)) (1 - E(mu_o))/(pi (1 - E_avg))  [1/sr]
f_ss = GGX with height-correlated masking and Schlick's Fresnel, E its albedo for F = 1,
k = F_avg^2 E_avg/(1 - F_avg (1 - E_avg)),  F_avg = f0 + (1 - f0)/21

Sampling: visible normals for half of the samples, cosine-weighted for the rest.
alpha: GGX width, 1e-4 to 1.  f0: reflectance at normal incidence, 0 to 1; 1 reflects everything.
Source: Kulla & Conty 2017, "Revisiting physically based shading at Imageworks", SIGGRAPH course;
Heitz 2014, eq. 99. 1 - E is tabulated per alpha with relative error below 1e-10.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._energy import Table, average_lost, lost, table
from montecarlo_brdf.models._microfacet import (
    ggx_reflection,
    ggx_visible_pdf,
    half_sums,
    sample_visible,
    schlick,
)
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    alpha: float = 0.3
    f0: float = 1.0


domain = {"alpha": (1e-4, 1.0), "f0": (0.0, 1.0)}
verified = [Params(), Params(alpha=1.0), Params(alpha=0.05), Params(alpha=0.3, f0=0.04)]
lossless = [Params(alpha=a) for a in (0.05, 0.3, 1.0)]
lobe = ("half vector", lambda p: p.alpha)


def prepare(p: Params) -> Table:
    """The table of 1 - E and the factor of the second term."""
    made = table(p.alpha, p.f0)
    average = average_lost(p.alpha)
    fresnel = p.f0 + (1.0 - p.f0) / 21.0
    colour = fresnel * fresnel * (1.0 - average) / (1.0 - fresnel * average)
    return made._replace(factor=colour / (math.pi * average))


def f(wo: Vec, wi: Vec, p: Table) -> float:
    """One reflection, and all the others."""
    h = half_sums(wo, wi)
    single = schlick(h, p.f0) * ggx_reflection(h, wo, wi, p.alpha)
    return single + p.factor * lost(wi[2], p) * lost(wo[2], p)


def sample(wo: Vec, u: Vec, p: Table) -> Vec:
    """One of the two, chosen by u[2]."""
    if u[2] < 0.5:
        return sample_visible(wo, u, p.alpha, p.alpha)
    return random_hemisphere_cosine(u[0], u[1])


def pdf(wo: Vec, wi: Vec, p: Table) -> float:
    """The density of the mixture."""
    return 0.5 * ggx_visible_pdf(wo, wi, p.alpha) + 0.5 * wi[2] / math.pi
