"""Phong as it is printed: pow(max(0, r.v), n).

The cosine c near 1 is rounded by eps/2 and c^n multiplies that by n: 3e-4, 3e-3, 3e-2 in single
precision at n = 1e4, 1e5, 1e6. To ship: exp(n log1p(-d)) with d = |r - v|^2/2, as `phong` does.
"""

from __future__ import annotations

import math

from montecarlo_brdf.models.phong import Params, domain, lobe
from montecarlo_brdf.vectors import Vec, clamped_cosine, mirrored

same_as = "phong"


def f(wo: Vec, wi: Vec, p: Params) -> float:
    """ks (n+2)/(2 pi) (r.v)^n."""
    c = clamped_cosine(mirrored(wo), wi)
    return p.ks * (p.n + 2.0) / (2.0 * math.pi) * math.pow(c, p.n)
