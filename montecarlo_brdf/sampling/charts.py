"""Charts of the hemisphere fitted to an integrand, so that it is smooth and periodic on the square.

A chart turns (u1, u2) into a direction and the solid angle per unit square there. Lattices need
periodic integrands: every chart runs its coordinates through `smooth_step`, which stretches the
ends until values and two derivatives vanish there.

A chart of a lobe is made in steps, which a kernel takes one at a time for a whole block of points:
polynomials (`polar`), then roots (`half_horizon`, `mirror_horizon`), then quotients. In one piece
they are a chain of operations that a processor mostly waits for.
"""
from __future__ import annotations

import math

from montecarlo_brdf.special import cos_half_turn, sin_half_turn, turn
from montecarlo_brdf.vectors import Vec

Polar = tuple[float, float, float, float, float]
Row = tuple[float, float, float, float, float, float, float, float]


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


def polar(u1: float, u2: float) -> Polar:
    """(w, 1 - w, dw/du1, cos phi, sin phi): a point's radial step and its azimuth."""
    w, rest, slope = smooth_step(u1)
    c, s = turn(u2)
    return w, rest, slope, c, s


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


def radial(at: Row, scale: float) -> tuple[float, float, float, float]:
    """(t, dt/du, 1/(1 + t^2), (end - t)(t + 1/end)/(1 + t^2)) with t in [0, end].

    t = s w end/(s + end (1 - w)): half of the numbers lie within about `scale` = s. One division
    serves all: on vectors it costs as much as ten products.
    """
    w, rest, slope, _, _, _, n, d = at
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


def stretching(wo: Vec) -> float:
    """How much azimuths are stretched towards the plane of incidence."""
    return 1.0 / math.sqrt(math.sqrt(wo[2]))


def half_horizon(wo: Vec, at: Polar) -> Row:
    """Polar coordinates, the stretch of the azimuth there, and where t ends, as a fraction whose
    numerator and denominator are that times those of `farthest`: both roots at the same time."""
    w, rest, slope, c, s = at
    so, mu, stretch = azimuth_of(wo)[2], wo[2], stretching(wo)
    square = stretch * stretch + (1.0 - stretch * stretch) * c * c
    side = math.sqrt(square)
    m = so * abs(c) + math.sqrt(so * so * c * c + mu * mu * square)
    n, d = (m, mu * side) if c >= 0.0 else (mu * side, m)
    return w, rest, slope, c, s, side, n, d


def half_vector(wo: Vec, at: Row, width: float) -> tuple[float, float, float, float]:
    """(x, y, z, solid angle) from `half_horizon`, through the slope t = tan(theta_h) of the half
    vector.

    t runs from 0 to its value at the horizon; dwi = 4 (h.v) dwh. The cosine of wi is a product of
    positive terms, exact to rounding at the horizon.
    """
    ex, ey, so = azimuth_of(wo)
    mu, stretch = wo[2], stretching(wo)
    t, dt, cos2, above = radial(at, 2.0 * width)
    root = 1.0 / at[5]
    c, s = at[3] * root, stretch * at[4] * root
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
    stretch = stretching(wo)
    turned = stretch * c * c + (1.0 - c * c) / stretch
    dt = steepest(t, farthest(so * c, wo[2]), 2.0 * width)
    cos2 = 1.0 / (1.0 + t * t)
    return 8.0 * math.pi * (so * c * t + wo[2]) * cos2 * cos2 * t * dt * turned


def mirror_horizon(wo: Vec, at: Polar) -> Row:
    """Polar coordinates and where t ends: the horizon lies where the half vector's does, with the
    same equation for t."""
    w, rest, slope, c, s = at
    return w, rest, slope, c, s, 1.0, *farthest(azimuth_of(wo)[2] * c, wo[2])


def mirror(wo: Vec, at: Row, width: float) -> tuple[float, float, float, float]:
    """(x, y, z, solid angle) from `mirror_horizon`, through the tangent t of half the angle to the
    mirror direction."""
    ex, ey, so = azimuth_of(wo)
    c, s = at[3], at[4]
    t, dt, cos2, above = radial(at, width)
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


def panels(wo: Vec, u1: float, u2: float) -> Row:
    """(x, y, z, d(projected solid angle)) in two panels of the cosine chart, one on either side of
    wo's height.

    Panels meet where theta_i = theta_o and where cos(phi_i - phi_o) = 0. These two are on wo's
    side; (-x, -y, z) lies in their opposites.
    """
    ex, ey, so = azimuth_of(wo)
    w, rest, slope = smooth_step(u1)
    b, _, across = smooth_step(u2)
    c, s = cos_half_turn(b - 0.5), sin_half_turn(b - 0.5)
    x, y = c * ex - s * ey, c * ey + s * ex
    mu2, so2 = wo[2] * wo[2], so * so
    high, above = math.sqrt(so2 * w), math.sqrt(mu2 + so2 * rest)
    low, below = math.sqrt(so2 + mu2 * w), math.sqrt(mu2 * rest)
    area = 0.5 * math.pi * slope * across
    return high * x, high * y, above, so2 * area, low * x, low * y, below, mu2 * area
