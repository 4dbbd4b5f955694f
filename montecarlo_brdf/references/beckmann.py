"""Beckmann microfacets with exact height-correlated Smith masking and Schlick's Fresnel.

Beckmann & Spizzichino 1963; Walter et al. 2007; Heitz 2014. f0 = 1 means F = 1.
"""

from functools import partial

from montecarlo_brdf.references import cook_torrance

RECIPROCAL = True

albedo = partial(cook_torrance.albedo, distribution="beckmann")
bihemispherical = partial(cook_torrance.bihemispherical, distribution="beckmann")
