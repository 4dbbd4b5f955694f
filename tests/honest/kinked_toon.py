"""Toon shading: two tones with a step, reciprocal."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    tone = 1.0 if wi[2] > 0.5 and wo[2] > 0.5 else 0.3
    return tone * p.albedo / math.pi
