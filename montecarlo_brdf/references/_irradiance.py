"""Closed forms under skies: irradiance E (Lambert's radiance is c E/pi), and what lobes reflect.

The axis u of a sky stands at the angle beta from the normal. Sources: Ramamoorthi & Hanrahan 2001
(spherical harmonics, eq. 8 and 12); Arvo 1995 (powers of the cosine); the cap is the projected
area of a spherical cap that the horizon cuts (Stokes on its two arcs).
"""

import math
from collections.abc import Sequence

from montecarlo_brdf.references._phong import double_axis
from montecarlo_brdf.references._truth import Truth, closed_form


def constant() -> float:
    """L = 1."""
    return math.pi


def linear(a: float, b: float, cos_beta: float) -> float:
    """L = a + b (w.u)."""
    return math.pi * a + 2.0 * math.pi / 3.0 * b * cos_beta


def quadratic(cos_beta: float) -> float:
    """L = (w.u)^2."""
    return 0.25 * math.pi * (1.0 + cos_beta * cos_beta)


def cosine(m: float, cos_beta: float) -> float:
    """L = max(0, w.u)^m: the double-axis moment; minus 2 pi cos/(m+2) beyond 90 degrees."""
    return 2.0 * math.pi / (m + 2.0) * (double_axis(abs(cos_beta), m) + min(0.0, cos_beta))


def cap(gamma: float, beta: float) -> float:
    """L = 1 within gamma of the axis (radians), which stands at beta, also below the horizon."""
    if gamma > 0.5 * math.pi:
        return math.pi - cap(math.pi - gamma, math.pi - beta)
    if beta + gamma <= 0.5 * math.pi:
        return math.pi * math.sin(gamma) ** 2 * math.cos(beta)
    if beta >= 0.5 * math.pi + gamma:
        return 0.0
    x = math.cos(gamma) / math.sin(gamma)
    y = max(-1.0, min(1.0, -x * math.cos(beta) / math.sin(beta)))
    q = math.sin(beta) * math.sqrt((1.0 - y) * (1.0 + y))
    part = math.cos(beta) * math.acos(y) - x * q
    return max(0.0, math.sin(gamma) ** 2 * part + math.atan2(q, x))


def harmonics(coefficients: Sequence[float]) -> float:
    """L = sum L_lm Y_lm, bands 0 to 4: only m = 0 has irradiance on the plane z = 0."""
    factors = (math.pi, 2.0 * math.pi / 3.0, 0.25 * math.pi, 0.0, -math.pi / 24.0)
    zonal = (coefficients[band * (band + 1)] for band in range(5))
    return math.fsum(
        factor * value * math.sqrt((2 * band + 1) / (4.0 * math.pi))
        for band, (factor, value) in enumerate(zip(factors, zonal, strict=True))
    )


def image(rows: Sequence[float], columns: int) -> float:
    """Rows from the zenith down, each the sum of its texels: E = sum L dphi (s2^2 - s1^2)/2."""
    height = len(rows)
    total = []
    for k, row in enumerate(rows):
        top, bottom = math.pi * k / height, min(math.pi * (k + 1) / height, 0.5 * math.pi)
        if top < bottom:
            total.append(row * (math.sin(bottom) ** 2 - math.sin(top) ** 2))
    return math.fsum(total) * math.pi / columns


def cosine_sky(name: str, mu: float, m: float, **parameters: float) -> Truth | None:
    """L_o under max(0, cos theta_i)^m around the normal; None where there is no closed form.

    Minnaert: the formula of A with one more power of the cosine per m. Phong from the normal only.
    """
    if name == "minnaert":
        k = parameters["k"]
        value = 2.0 * parameters["albedo"] * mu ** (k - 1.0) / (k + 1.0 + m)
        return closed_form(value, "Minnaert under a power of the cosine", condition=abs(k - 1.0))
    if name == "phong" and mu == 1.0:
        n = parameters["n"]
        value = parameters["ks"] * (n + 2.0) / (n + 2.0 + m)
        return closed_form(value, "Phong at the normal under a power of the cosine")
    return None
