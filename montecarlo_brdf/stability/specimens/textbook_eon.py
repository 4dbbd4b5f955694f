"""EON with the albedo term (s/mu)(1 - s^3) and 1 - E as they are printed.

1 - s^3 cancels at grazing and the division by mu blows it up: in single precision the term is
wrong by 7.8e-4 near mu = 1.7e-4. To ship: s mu (1 + s + s^2)/(1 + s) for it, and 1 - E written with
terms that vanish at grazing, as `eon` does.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from montecarlo_brdf.vectors import Vec


class Params(NamedTuple):
    albedo: float = 0.8
    roughness: float = 0.5


domain = {"albedo": (0.0, 1.0), "roughness": (1e-3, 1.0)}
same_as = "eon"


def term(mu: float) -> float:
    """(s/mu)(1 - s^3) with s = sqrt(1 - mu^2)."""
    s = math.sqrt(1.0 - mu * mu)
    return s / mu * (1.0 - s * s * s)


def term_to_ship(mu: float) -> float:
    """The same without cancellation."""
    s = math.sqrt(1.0 - mu * mu)
    return s * mu * (1.0 + s + s * s) / (1.0 + s)


def albedo(mu: float, roughness: float) -> float:
    """E of FON with albedo 1."""
    s = math.sqrt(max(0.0, 1.0 - mu * mu))
    g = s * (math.acos(min(1.0, mu)) - s * mu) + 2.0 / 3.0 * (s / mu * (1.0 - s * s * s) - s)
    return (1.0 + roughness / math.pi * g) / (1.0 + (0.5 - 2.0 / (3.0 * math.pi)) * roughness)


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """f_ss + f_ms."""
    s = wi[0] * wo[0] + wi[1] * wo[1]
    ratio = s / max(wi[2], wo[2]) if s > 0.0 else s
    a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * math.pi)) * p.roughness)
    mean = a * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * math.pi)) * p.roughness)
    once = p.albedo / math.pi * a * (1.0 + p.roughness * ratio)
    many = p.albedo * p.albedo * mean / (1.0 - p.albedo * (1.0 - mean))
    lost = (1.0 - albedo(wi[2], p.roughness)) * (1.0 - albedo(wo[2], p.roughness))
    return once + many / math.pi * lost / (1.0 - mean)
