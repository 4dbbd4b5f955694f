"""Failure 39. Lambert without 1/pi."""

from typing import NamedTuple

found_by = ("run", "furnace")
domain = {"albedo": (0.0, 1.0)}


class Params(NamedTuple):
    albedo: float = 0.8


def f(wo, wi, p):
    return p.albedo
