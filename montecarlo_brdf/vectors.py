"""3-vectors as plain tuples (x, y, z) in the tangent frame, n = (0, 0, 1).

Every function works uncompiled, inside kernels, and on NumPy arrays of any float type where it
has no branch. Directions are unit vectors pointing away from the surface; angles are radians.
"""
from __future__ import annotations

import math

Vec = tuple[float, float, float]

NORMAL: Vec = (0.0, 0.0, 1.0)


def dot(a: Vec, b: Vec) -> float:
    """a . b"""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    """a x b"""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a: Vec) -> float:
    """|a|"""
    return math.sqrt(dot(a, a))


def normalised(a: Vec) -> Vec:
    """a / |a|; the zero vector gives NaN components, as it has no direction."""
    s = 1.0 / length(a)
    return a[0] * s, a[1] * s, a[2] * s


def from_degrees(theta_deg: float, phi_deg: float = 0.0) -> Vec:
    """Unit vector at (theta, phi) in degrees.

    The cosine of an angle beyond 45 degrees is the sine of its complement, which is exact in
    doubles: cos(89.99 degrees) keeps all its digits instead of losing four.
    """
    steep = theta_deg > 45.0
    rest = math.radians(90.0 - theta_deg if steep else theta_deg)
    s, c = (math.cos(rest), math.sin(rest)) if steep else (math.sin(rest), math.cos(rest))
    phi = math.radians(phi_deg)
    return s * math.cos(phi), s * math.sin(phi), c


def mirrored(a: Vec) -> Vec:
    """Mirror direction about n: (-x, -y, z)."""
    return -a[0], -a[1], a[2]


def reflect(direction: Vec, normal: Vec) -> Vec:
    """r = 2 (n . l) n - l: `direction` (away from the surface) reflected about `normal`."""
    d = 2.0 * dot(direction, normal)
    return d * normal[0] - direction[0], d * normal[1] - direction[1], d * normal[2] - direction[2]


def half_vector(wi: Vec, wo: Vec) -> Vec:
    """h = (wi + wo) / |wi + wo|; NaN where wi = -wo, which has no half vector."""
    return normalised((wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]))


def clamped_cosine(a: Vec, b: Vec) -> float:
    """max(0, a . b), the cosine that light and lobes use."""
    return max(0.0, dot(a, b))


def tangent_frame(n: Vec) -> tuple[Vec, Vec]:
    """Tangent and bitangent that make (t, b, n) right-handed and orthonormal.

    Branchless and continuous but for the sign at n.z = 0; holds at both poles.
    Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1), listing 3.
    """
    sign = math.copysign(1.0, n[2])
    a = -1.0 / (sign + n[2])
    b = n[0] * n[1] * a
    tangent = (1.0 + sign * n[0] * n[0] * a, sign * b, -sign * n[0])
    return tangent, (b, sign + n[1] * n[1] * a, -n[1])
