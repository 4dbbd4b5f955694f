"""Charts of the hemisphere fitted to an integrand, so that it is smooth and periodic on the square.

A chart turns (u1, u2) into a direction and the solid angle per unit square there. Lattices need
periodic integrands: every chart runs its coordinates through `smooth_step`, which stretches the
ends until values and two derivatives vanish there.
"""
from __future__ import annotations

import math

from montecarlo_brdf.special import cos_half_turn, sin_half_turn, turn
from montecarlo_brdf.vectors import Vec


def smooth_step(u: float) -> tuple[float, float, float]:
    """(w, 1 - w, dw/du) of w = u^3 (10 - 15 u + 6 u^2), each free of cancellation.

    Source: Sidi 1993, "A new variable transformation for numerical integration", p = 3 polynomial.
    """
    v = 1.0 - u
    uv = u * v
    return (
        u * u * u * (10.0 - u * (15.0 - 6.0 * u)),
        v * v * v * (10.0 - v * (15.0 - 6.0 * v)),
        30.0 * uv * uv,
    )


def azimuth_of(wo: Vec) -> Vec:
    """(cos phi, sin phi, sin theta) of a direction; phi = 0 at the pole."""
    s = math.sqrt(wo[0] * wo[0] + wo[1] * wo[1])
    away = s > 1e-150  # the squares of less have lost their digits
    inverse = 1.0 / s if away else 0.0
    return (wo[0] * inverse if away else 1.0), wo[1] * inverse, s


def farthest(q: float, mu: float) -> tuple[float, float]:
    """tan(theta_h) of the half vector whose reflection of wo lies on the horizon, as a fraction.

    q = sin(theta_o) cos(phi_h), mu = cos(theta_o): the positive root of mu t^2 - 2 q t = mu.
    """
    m = abs(q) + math.sqrt(q * q + mu * mu)
    return (m, mu) if q >= 0.0 else (mu, m)


def radial(
    u: float, end: tuple[float, float], scale: float
) -> tuple[float, float, float, float]:
    """(t, dt/du, 1/(1 + t^2), (end - t)(t + 1/end)/(1 + t^2)) with t in [0, end].

    t = s w end/(s + end (1 - w)): half of the numbers lie within about `scale` = s. One division
    serves all: on vectors it costs as much as ten products.
    """
    w, rest, slope = smooth_step(u)
    n, d = end
    number, below = scale * w * n, scale * d + n * rest
    square = below * below + number * number
    inverse = 1.0 / (below * square * d)
    inverse_square = inverse * below * d
    inverse_below = inverse * square * d
    t = number * inverse_below
    steep = scale * n * (scale * d + n) * slope
    cos2 = below * below * inverse_square
    above = (scale * d + n) * rest * (number * n + d * below) * inverse * below
    return t, steep * inverse_below * inverse_below, cos2, above


def steepest(t: float, end: tuple[float, float], scale: float) -> float:
    """The largest that dt/du of `radial` can be at t: with the step at its steepest, 15/8."""
    last = end[0] / end[1]
    return 1.875 * last * (scale + t) * (scale + t) / (scale * (scale + last))


def half_vector(wo: Vec, u1: float, u2: float, width: float) -> tuple[float, float, float, float]:
    """(x, y, z, solid angle) through the slope t = tan(theta_h) of the half vector.

    t runs from 0 to its value at the horizon; the azimuth is stretched towards the plane of
    incidence when wo is low; dwi = 4 (h.v) dwh. The cosine of wi is a product of positive terms,
    exact to rounding at the horizon.
    """
    ex, ey, so = azimuth_of(wo)
    mu = wo[2]
    c, s = turn(u2)
    stretch = 1.0 / math.sqrt(math.sqrt(mu))
    square = stretch * stretch + (1.0 - stretch * stretch) * c * c
    side = math.sqrt(square)
    # the end of t, with numerator and denominator times `side`: both roots at the same time
    m = so * abs(c) + math.sqrt(so * so * c * c + mu * mu * square)
    end = (m, mu * side) if c >= 0.0 else (mu * side, m)
    t, dt, cos2, above = radial(u1, end, 2.0 * width)
    root = 1.0 / side
    c, s = c * root, stretch * s * root
    q = so * c
    facing = q * t + mu  # h.v/h.n
    k = 2.0 * facing * cos2
    x, y = k * t * c - so, k * t * s
    area = 8.0 * math.pi * facing * cos2 * cos2 * t * dt * stretch * root * root
    return x * ex - y * ey, x * ey + y * ex, mu * above, area


def half_vector_area(wo: Vec, wi: Vec, width: float) -> float:
    """The largest that the solid angle of `half_vector` can be at wi."""
    ex, ey, so = azimuth_of(wo)
    hx, hy, hz = wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]
    t = math.sqrt(hx * hx + hy * hy) / hz
    c = (hx * ex + hy * ey) / (t * hz) if t > 0.0 else 1.0
    stretch = 1.0 / math.sqrt(math.sqrt(wo[2]))
    turned = stretch * c * c + (1.0 - c * c) / stretch
    dt = steepest(t, farthest(so * c, wo[2]), 2.0 * width)
    cos2 = 1.0 / (1.0 + t * t)
    return 8.0 * math.pi * (so * c * t + wo[2]) * cos2 * cos2 * t * dt * turned


def mirror(wo: Vec, u1: float, u2: float, width: float) -> tuple[float, float, float, float]:
    """(x, y, z, solid angle) through the tangent t of half the angle to the mirror direction.

    The horizon lies where the half vector's does, with the same equation for t.
    """
    ex, ey, so = azimuth_of(wo)
    c, s = turn(u2)
    t, dt, cos2, above = radial(u1, farthest(so * c, wo[2]), width)
    k = 2.0 * t * cos2
    x, y = k * c * wo[2] - (1.0 - t * t) * cos2 * so, k * s
    area = 8.0 * math.pi * t * dt * cos2 * cos2
    return x * ex - y * ey, x * ey + y * ex, wo[2] * above, area


def mirror_area(wo: Vec, wi: Vec, width: float) -> float:
    """The largest that the solid angle of `mirror` can be at wi."""
    ex, ey, so = azimuth_of(wo)
    x, y, z = wi[0] + wo[0], wi[1] + wo[1], wi[2] - wo[2]
    apart = math.sqrt(x * x + y * y + z * z)
    x2, y2, z2 = wi[0] - wo[0], wi[1] - wo[1], wi[2] + wo[2]
    t = apart / math.sqrt(x2 * x2 + y2 * y2 + z2 * z2)
    up = (x * ex + y * ey) * wo[2] + z * so
    c = up * (1.0 + t * t) / (2.0 * t) if t > 0.0 else 1.0
    cos2 = 1.0 / (1.0 + t * t)
    return 8.0 * math.pi * t * steepest(t, farthest(so * c, wo[2]), width) * cos2 * cos2


def panel(wo: Vec, u1: float, u2: float, high: bool) -> tuple[float, float, float, float]:
    """(x, y, z, d(projected solid angle)) in one of the panels of the cosine chart.

    Panels meet where theta_i = theta_o and where cos(phi_i - phi_o) = 0. `high`: closer to the
    normal than wo. This is the panel on wo's side; (-x, -y, z) lies in its opposite.
    """
    ex, ey, so = azimuth_of(wo)
    w, rest, slope = smooth_step(u1)
    b, _, across = smooth_step(u2)
    mu2, so2 = wo[2] * wo[2], so * so
    r2, z2 = (so2 * w, mu2 + so2 * rest) if high else (so2 + mu2 * w, mu2 * rest)
    r = math.sqrt(r2)
    c, s = r * cos_half_turn(b - 0.5), r * sin_half_turn(b - 0.5)
    area = (so2 if high else mu2) * slope * 0.5 * math.pi * across
    return c * ex - s * ey, c * ey + s * ex, math.sqrt(z2), area
