"""Failure 45. Lommel-Seeliger eight times too bright."""

import math

found_by = ("run", "energy")


def f(wo, wi, p):
    return 8.0 * 0.8 / (2.0 * math.pi * (wi[2] + wo[2]))
