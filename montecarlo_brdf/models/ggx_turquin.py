"""GGX scaled up by the energy that masking loses towards the viewer (Turquin 2019).

f = f_ss (1 + f0 (1 - E(mu_o))/E(mu_o))  [1/sr]
f_ss = GGX with height-correlated masking and Schlick's Fresnel, E its albedo for F = 1

Sampling: visible normals.
alpha: GGX width, 1e-4 to 1.  f0: reflectance at normal incidence, 0 to 1; with 1 the furnace test
gives exactly 1.
Source: Turquin 2019, "Practical multiple scattering compensation for microfacet models", eq. 16;
Heitz 2014, eq. 99. 1 - E is tabulated per alpha with relative error below 1e-10.
Violates: reciprocity, and energy conservation although the furnace test passes: light at grazing
is reflected up to 2.20 times (alpha = 1; 1.39 for 0.5, 1.06 for 0.1).
"""
from __future__ import annotations

from montecarlo_brdf.models._energy import Table, lost, table
from montecarlo_brdf.models.ggx import Params, domain, lobe, pdf, sample
from montecarlo_brdf.models.ggx import f as single
from montecarlo_brdf.vectors import Vec

verified = [Params(), Params(alpha=1.0), Params(alpha=0.05), Params(alpha=0.3, f0=0.04)]
lossless = [Params(alpha=a) for a in (0.05, 0.3, 1.0)]
disclaims = {
    "reciprocity": "the compensation depends on mu_o only",
    "energy": "grazing light is reflected up to 2.20 times (alpha = 1), though the furnace gives 1",
}


def prepare(p: Params) -> Table:
    """The table of 1 - E."""
    return table(p.alpha, p.f0)


def f(wo: Vec, wi: Vec, p: Table) -> float:
    """One reflection, scaled."""
    once = single(wo, wi, p)
    missing = lost(wo[2], p)
    return once * (1.0 + p.f0 * missing / (1.0 - missing))
