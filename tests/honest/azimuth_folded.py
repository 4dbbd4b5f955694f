"""Azimuth by a tent: each direction belongs to two numbers."""

import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def cosine(u):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    return cosine((u[0], abs(2.0 * u[1] - 1.0)))


def pdf(wo, wi, p):
    return wi[2] / math.pi
