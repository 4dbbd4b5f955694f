"""An opposition spike like the distance from the viewer to the power -1.5, cut at 0.001: 30,000
times as bright as the rest, and integrable.

suite: slow
"""

from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.9


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    x, y, z = wo[0] - wi[0], wo[1] - wi[1], wo[2] - wi[2]
    return p.albedo / 18.0 * (x * x + y * y + z * z + 1e-6) ** -0.75
