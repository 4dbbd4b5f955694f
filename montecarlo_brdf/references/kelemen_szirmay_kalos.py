"""Kelemen & Szirmay-Kalos, Eurographics 2001: f = D F/(4 (h.v)^2), Beckmann D, Schlick F."""

from functools import partial

from montecarlo_brdf.references import beckmann

RECIPROCAL = True

albedo = partial(beckmann.albedo, masking="kelemen")
bihemispherical = partial(beckmann.bihemispherical, masking="kelemen")
