"""Lommel-Seeliger with its albedo tabulated every 5 degrees: one row is 3.7 % off.

suite: slow
caught by: furnace
cause: none
"""

import math
from typing import NamedTuple

TABLE = (
    0.15342641,
    0.15379481,
    0.15490815,
    0.15679133,
    0.15948736,
    0.16305988,
    0.16759704,
    0.17321729,
    0.18007787,
    0.18838738,
    0.19842479,
    0.21056900,
    0.22534693,
    0.23451615,
    0.26621868,
    0.29530000,
    0.33409297,
    0.39002586,
    0.50000000,
)


class Params(NamedTuple):
    w: float = 0.9


def f(wo, wi, p):
    return p.w / (4.0 * math.pi * (wo[2] + wi[2]))


def albedo(cos_theta_o, p):
    x = math.degrees(math.acos(min(1.0, cos_theta_o))) / 5.0
    i = min(int(x), 17)
    t = x - i
    return p.w * ((1.0 - t) * TABLE[i] + t * TABLE[i + 1])
