"""Azimuth from u[1] through a permutation of 1024 slices, as by a shuffled table."""
import math
from typing import NamedTuple


class Params(NamedTuple):
    albedo: float = 0.8


domain = {"albedo": (0.0, 1.0)}


def f(wo, wi, p):
    return p.albedo / math.pi


def sample(wo, u, p):
    k = math.floor(u[1] * 1024.0)
    b = ((k * 389.0) % 1024.0 + (u[1] * 1024.0 - k)) / 1024.0
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * b
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])


def pdf(wo, wi, p):
    return wi[2] / math.pi
