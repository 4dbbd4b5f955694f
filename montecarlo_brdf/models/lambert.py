"""Lambert: a perfectly diffuse surface.

f = albedo/pi  [1/sr]

Sampling: cosine-weighted, which has no variance at all.
albedo: fraction of light reflected, 0 to 1.
Source: Lambert 1760, Photometria.
"""
from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.models._cosine import pdf, sample
from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}
verified = [Params(), Params(albedo=1.0), Params(albedo=0.0)]
lossless = [Params(albedo=1.0)]
scales_with = "albedo"


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """The same in every direction."""
    return p.albedo / math.pi
