"""A table of 8 rings by 16 sectors, tint(wo) tint(wi) rho/pi; the sampler draws a cell from a flat
list and takes its number apart the wrong way round. The weight is the albedo of wo, so A holds.

suite: slow
caught by: radiance
cause: none
"""

import math
from typing import NamedTuple

import numpy as np


class Params(NamedTuple):
    albedo: float = 0.9


domain = {"albedo": (0.0, 1.0)}
isotropic = False
ROWS, COLUMNS = 8, 16
K = np.arange(ROWS * COLUMNS)
TINT = 0.7 + 0.3 * np.sin(0.9 * (K // COLUMNS)) * np.cos(2.0 * np.pi * (K % COLUMNS) / COLUMNS)
SUMS = np.concatenate((np.zeros(1), np.cumsum(TINT / TINT.sum())))
MEAN = float(TINT.mean())


def cell(w):
    i = min(ROWS - 1, int(w[2] * w[2] * ROWS))
    turn = math.atan2(w[1], w[0]) / (2.0 * math.pi)
    j = min(COLUMNS - 1, int((turn - math.floor(turn)) * COLUMNS))
    return i * COLUMNS + j


def f(wo, wi, p):
    return p.albedo * TINT[cell(wo)] * TINT[cell(wi)] / math.pi


def sample(wo, u, p):
    k = 0
    while k < ROWS * COLUMNS - 1 and SUMS[k + 1] <= u[2]:
        k += 1
    i, j = k % ROWS, k // ROWS
    z = math.sqrt((i + u[0]) / ROWS)
    s, phi = math.sqrt(max(0.0, 1.0 - z * z)), 2.0 * math.pi * (j + u[1]) / COLUMNS
    return s * math.cos(phi), s * math.sin(phi), z, p.albedo * TINT[cell(wo)] * MEAN
