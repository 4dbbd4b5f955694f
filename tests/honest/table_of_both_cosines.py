"""A measured table over both cosines, uneven and symmetric, interpolated bilinearly: kinks along a
grid of lines.

suite: slow
"""

import math
from typing import NamedTuple

import numpy as np


class Params(NamedTuple):
    albedo: float = 0.9


domain = {"albedo": (0.0, 1.0)}
N = 9
ROW = np.arange(N * N) // N
COLUMN = np.arange(N * N) % N
TABLE = (0.55 + 0.45 * np.sin(2.1 * (ROW + COLUMN)) * np.cos(1.7 * (ROW - COLUMN))).reshape(N, N)


def f(wo, wi, p):
    a, b = wo[2] * (N - 1), wi[2] * (N - 1)
    i, j = min(N - 2, int(a)), min(N - 2, int(b))
    s, t = a - i, b - j
    low = (1.0 - t) * TABLE[i, j] + t * TABLE[i, j + 1]
    high = (1.0 - t) * TABLE[i + 1, j] + t * TABLE[i + 1, j + 1]
    return p.albedo / math.pi * ((1.0 - s) * low + s * high)
