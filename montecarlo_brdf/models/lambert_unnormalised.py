"""Lambert without the division by pi, as shaders often write it.

f = c  [1/sr]

The albedo is pi c: a "diffuse colour" c = 1 reflects 3.14 times the light it receives.

Sampling: cosine-weighted.
c: value of the BRDF, 0 to 1; conserves energy up to c = 1/pi = 0.3183.
Source: common use in shaders; Lambert 1760, Photometria, with its factor 1/pi left out.
Violates: energy conservation for c > 1/pi.
"""
from __future__ import annotations

from typing import NamedTuple

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    c: float = 0.25


domain = {"c": (0.0, 1.0)}
verified = [Params()]
scales_with = "c"


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """The same in every direction."""
    return p.c
