"""Coordinates on the hemisphere of wi that follow a lobe: slope and azimuth of the half vector.

With H = wi + wo, t = tan(theta_h) and azimuth phi_h against the plane of incidence, the horizon
mu_i = 0 is the curve t_max(phi) = T cos(phi) + sqrt(T^2 cos^2(phi) + 1), T = tan(theta_o). So

    1 - (1 - x)^4 = log(1 + (t/s)^2) / log(1 + (t_max/s)^2),   b = phi_h/(2 pi),   x, b in [0, 1)

covers exactly the hemisphere, gives every scale from s to the horizon room, and turns a lobe of any
width into a smooth function. The power does so with what grows without bound towards the horizon
and can be integrated. dwi = 4 (h.v) cos^3(theta_h) t dt dphi (Walter et al.
2007). Without a call or a branch, so that loops become vector instructions.
"""
from __future__ import annotations

import math

from montecarlo_brdf.special import exp, expm1, log1p, polar_angle, turn
from montecarlo_brdf.vectors import Vec

TWO_PI = 2.0 * math.pi
#: slope of the half vector from which on a lobe is resolved where nothing is known of it
FINEST = 1e-3


def plane(wo: Vec) -> Vec:
    """(cos phi, sin phi, sin theta) of a direction; phi = 0 at the pole."""
    sine = math.sqrt(wo[0] * wo[0] + wo[1] * wo[1])
    inverse = 1.0 / max(sine, 1e-300)
    return (wo[0] * inverse if sine > 0.0 else 1.0), wo[1] * inverse, sine


def horizon(sine: float, mu: float, cos_phi: float) -> float:
    """t_max, without cancellation on either side."""
    k = sine / mu * cos_phi
    root = abs(k) + math.sqrt(k * k + 1.0)
    return root if k >= 0.0 else 1.0 / root


def direction(x: float, b: float, wo: Vec, scale: float) -> tuple[float, float, float, float]:
    """wi, and dwi/(dx db) in sr, for (x, b) in [0, 1)^2; scale: the s above."""
    ex, ey, sine = plane(wo)
    c, s = turn(b)  # begins at -pi
    c, s = -c, -s
    last, s2 = horizon(sine, wo[2], c), scale * scale
    rest = (1.0 - x) * (1.0 - x)
    to_end, slope = rest * rest, 4.0 * rest * (1.0 - x)
    span = log1p(last * last / s2)
    grown = s2 * exp((1.0 - to_end) * span)
    t2 = s2 * expm1((1.0 - to_end) * span)
    t = math.sqrt(t2)
    to_horizon = grown * expm1(to_end * span) / (last + t)
    z = 1.0 / math.sqrt(1.0 + t2)
    dot = z * (wo[2] + sine * c * t)
    along, across = 2.0 * dot * z * t * c - sine, 2.0 * dot * z * t * s
    up = wo[2] * to_horizon * (t + 1.0 / last) * (z * z)
    length = 1.0 / math.sqrt(along * along + across * across + up * up)
    along, across = along * length, across * length
    area = 2.0 * TWO_PI * dot * z * z * z * grown * span * slope
    return ex * along - ey * across, ey * along + ex * across, up * length, area


def coordinates(wi: Vec, wo: Vec, scale: float) -> tuple[float, float]:
    """(x, b) of a direction above the horizon."""
    ex, ey, sine = plane(wo)
    hx, hy, hz = wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]
    along, across = hx * ex + hy * ey, hy * ex - hx * ey
    slope = math.sqrt(along * along + across * across)
    inverse = 1.0 / max(slope, 1e-300)
    c, s = abs(along) * inverse, abs(across) * inverse
    c = c if slope > 0.0 else 1.0  # the centre counts as azimuth 0
    turned = polar_angle(s, c) / TWO_PI
    turned = 0.5 - turned if along < 0.0 else turned
    turned = 1.0 - turned if across < 0.0 else turned
    last = horizon(sine, wo[2], -c if along < 0.0 else c) / scale
    steep = slope / (hz * scale)
    to_end = 1.0 - log1p(steep * steep) / log1p(last * last)
    return 1.0 - math.sqrt(math.sqrt(max(0.0, to_end))), turned
