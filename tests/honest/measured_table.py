"""A table over half and difference angles, as measured materials are stored (Matusik et al. 2003):
90 x 90 x 180 cells of constant value.

suite: slow
"""

import math

import numpy as np


def made_up():
    i = np.arange(90)
    th = (i / 90.0) ** 2 * (math.pi / 2)
    td = np.arange(90) / 90.0 * (math.pi / 2)
    a2 = 0.3**4
    d = a2 / (math.pi * ((a2 - 1.0) * np.cos(th) ** 2 + 1.0) ** 2)
    f = 0.04 + 0.96 * (1.0 - np.cos(td)) ** 5
    base = 0.4 / math.pi + (d[:, None] * f[None, :]) / 4.0
    pd = (np.arange(180) + 0.5) / 180.0 * math.pi
    ripple = 1.0 + 0.2 * np.sin(td)[:, None] ** 2 * np.cos(2.0 * pd)[None, :]
    return base[:, :, None] * ripple[None, :, :]


TABLE = np.ascontiguousarray(made_up())


def angles(wo, wi):
    """Rusinkiewicz: half and difference angles."""
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    n = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / n, y / n, z / n
    theta_h = math.acos(min(1.0, z))
    s = math.sqrt(x * x + y * y)
    cp, sp = (x / s, y / s) if s > 0.0 else (1.0, 0.0)
    # turn by -phi_h about n, then by -theta_h about the bitangent
    ax, ay = cp * wi[0] + sp * wi[1], cp * wi[1] - sp * wi[0]
    dx, dz = z * ax - s * wi[2], s * ax + z * wi[2]
    return theta_h, math.acos(max(-1.0, min(1.0, dz))), math.atan2(ay, dx)


def lookup(theta_h, theta_d, phi_d):
    i = min(89, int(90.0 * math.sqrt(max(0.0, theta_h) / (0.5 * math.pi))))
    j = min(89, int(90.0 * theta_d / (0.5 * math.pi)))
    k = max(0, min(179, int(180.0 * phi_d / math.pi)))
    return TABLE[i, j, k]


def f(wo, wi, p):
    theta_h, theta_d, phi_d = angles(wo, wi)
    return lookup(theta_h, theta_d, phi_d + math.pi if phi_d < 0.0 else phi_d)
