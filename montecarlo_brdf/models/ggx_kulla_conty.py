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

from montecarlo_brdf.models import ggx
from montecarlo_brdf.models._energy import Table, average_lost, lost, table
from montecarlo_brdf.models.ggx import Params, domain, lobe
from montecarlo_brdf.models.ggx_turquin import lossless, verified
from montecarlo_brdf.sampling.warps import random_hemisphere_cosine
from montecarlo_brdf.vectors import Vec


def prepare(p: Params) -> Table:
    """The table of 1 - E and the factor of the second term."""
    made = table(p.alpha, p.f0)
    average = average_lost(p.alpha)
    fresnel = p.f0 + (1.0 - p.f0) / 21.0
    colour = fresnel * fresnel * (1.0 - average) / (1.0 - fresnel * average)
    return made._replace(factor=colour / (math.pi * average))


def f(wo: Vec, wi: Vec, p: Table) -> float:
    """One reflection, and all the others."""
    return ggx.f(wo, wi, p) + p.factor * lost(wi[2], p) * lost(wo[2], p)


def sample(wo: Vec, u: Vec, p: Table) -> Vec:
    """One of the two, chosen by u[2]."""
    return ggx.sample(wo, u, p) if u[2] < 0.5 else random_hemisphere_cosine(u[0], u[1])


def pdf(wo: Vec, wi: Vec, p: Table) -> float:
    """The density of the mixture."""
    return 0.5 * ggx.pdf(wo, wi, p) + 0.5 * wi[2] / math.pi
