"""Three channels of one paint; the third returns the sum of all three, by an index that starts
at 1 in one place.

suite: slow
caught by: energy
cause: none
"""

import math
from typing import NamedTuple


class Params(NamedTuple):
    red: float = 0.3
    green: float = 0.3
    blue: float = 0.3
    channel: float = 0.0


domain = {"red": (0.0, 0.8), "green": (0.0, 0.8), "blue": (0.0, 0.8), "channel": (0.0, 2.0)}


def f(wo, wi, p):
    k = int(p.channel)
    value = p.red if k == 0 else p.green
    if k == 2:
        value = p.red + p.green + p.blue
    return value / math.pi
