"""What Fujii's model and its descendants FON and EON share."""
from __future__ import annotations

import math

from montecarlo_brdf.special import polar_angle
from montecarlo_brdf.vectors import Vec

G_GRAZING = 0.5 * math.pi - 2.0 / 3.0


def tangential_ratio(wo: Vec, wi: Vec) -> float:
    """s/t with s = sin_i sin_o cos(dphi), t = max(mu_i, mu_o) if s > 0 else 1.

    s is clamped to its range: rounded below -1 it would make f negative where f is 0.
    """
    s = max(-1.0, wi[0] * wo[0] + wi[1] * wo[1])
    return s / max(wi[2], wo[2]) if s > 0.0 else s


def fon_scale(roughness: float) -> float:
    """A = 1/(1 + (1/2 - 2/(3 pi)) roughness), which makes the albedo 1 at grazing."""
    return 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * math.pi)) * roughness)


def missing(w: Vec) -> float:
    """G(pi/2) - G(theta), to which the light that FON loses is proportional.

    With gamma = pi/2 - theta and mu = sin(gamma) every term vanishes at grazing, so it keeps its
    digits there, where G(pi/2) - G would cancel.
    """
    mu = w[2]
    s = math.sqrt(w[0] * w[0] + w[1] * w[1])
    q = 1.0 / (1.0 + s)
    dip = G_GRAZING * mu * mu * q + s * s * mu + s * polar_angle(mu, s)
    return dip - 2.0 / 3.0 * s * mu * (1.0 + s + s * s) * q
