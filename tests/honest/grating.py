"""Five diffraction orders of a grating along x: wi_x = -wo_x + m 0.35, each a bell of width 0.004
in (x, y); orders are chosen by u[2], those outside the hemisphere are rejected."""
import math
from typing import NamedTuple


class Params(NamedTuple):
    ks: float = 0.5


domain = {"ks": (0.0, 0.9)}
isotropic = False
W2 = 0.004**2
STEP = 0.35


def bells(wo, wi):
    x, y = wo[0] + wi[0], wo[1] + wi[1]
    m = math.floor(x / STEP + 0.5)
    x -= m * STEP
    share = 0.4 if m == 0.0 else (0.2 if abs(m) == 1.0 else (0.1 if abs(m) == 2.0 else 0.0))
    return share * math.exp(-0.5 * (x * x + y * y) / W2) / (2.0 * math.pi * W2)


def f(wo, wi, p):
    return p.ks * bells(wo, wi)


def sample(wo, u, p):
    if u[2] < 0.4:
        m = 0.0
    elif u[2] < 0.6:
        m = 1.0
    elif u[2] < 0.8:
        m = -1.0
    elif u[2] < 0.9:
        m = 2.0
    else:
        m = -2.0
    r = math.sqrt(-2.0 * W2 * math.log(1.0 - u[0]))
    phi = 2.0 * math.pi * u[1]
    x, y = -wo[0] + m * STEP + r * math.cos(phi), -wo[1] + r * math.sin(phi)
    z2 = 1.0 - x * x - y * y
    return x, y, (math.sqrt(z2) if z2 > 0.0 else -1.0)


def pdf(wo, wi, p):
    return bells(wo, wi) * wi[2]
