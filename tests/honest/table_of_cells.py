"""Lambert drawn by 90 x 360 cells of a degree, constant in each, as measured tables are."""
import math
from typing import NamedTuple

import numpy as np


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}
NT, NP = 90, 360
k = np.arange(NP)
AZ = 1.0 + 0.3 * np.sin(k * 12.9898) * np.cos(k * 78.233)  # uneven, +-30 %
AZ = AZ / AZ.sum()
CA = np.concatenate((np.zeros(1), np.cumsum(AZ)))
CA[-1] = 1.0
EDGE = np.cos(np.radians(np.arange(NT + 1.0)))  # of cos theta, 1 down to 0
EDGE[-1] = 0.0
ZE = EDGE[:-1] ** 2 - EDGE[1:] ** 2  # cosine-weighted share of each ring
ZE = ZE * (1.0 + 0.2 * np.sin(np.arange(NT) * 5.1))
ZE = ZE / ZE.sum()
CZ = np.concatenate((np.zeros(1), np.cumsum(ZE)))
CZ[-1] = 1.0


def find(table, n, x):
    low, high = 0, n
    while high - low > 1:
        mid = (low + high) // 2
        if table[mid] <= x:
            low = mid
        else:
            high = mid
    return low


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    i = find(CZ, NT, u[0])
    j = find(CA, NP, u[1])
    t = (u[0] - CZ[i]) / (CZ[i + 1] - CZ[i])
    z = EDGE[i] + t * (EDGE[i + 1] - EDGE[i])
    b = (j + (u[1] - CA[j]) / (CA[j + 1] - CA[j])) / NP
    r = math.sqrt(max(0.0, 1.0 - z * z))
    return r * math.cos(2.0 * math.pi * b), r * math.sin(2.0 * math.pi * b), z


def pdf(wo, wi, p):
    i = min(NT - 1, int(math.degrees(math.acos(min(1.0, wi[2])))))
    b = math.atan2(wi[1], wi[0]) / (2.0 * math.pi)
    j = min(NP - 1, int((b if b >= 0.0 else b + 1.0) * NP))
    return ZE[i] / (EDGE[i] - EDGE[i + 1]) * AZ[j] * NP / (2.0 * math.pi)
