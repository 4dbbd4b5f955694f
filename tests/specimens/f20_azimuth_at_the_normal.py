"""Failure 20.

Oren-Nayar with azimuth vectors normalised, also at normal incidence where there is none.
"""

import math

found_by = ("run", "positivity")


def f(wo, wi, p):
    s_i, s_o = math.sqrt(wi[0] ** 2 + wi[1] ** 2), math.sqrt(wo[0] ** 2 + wo[1] ** 2)
    c = (wi[0] / s_i) * (wo[0] / s_o) + (wi[1] / s_i) * (wo[1] / s_o)
    return 0.6 / math.pi * (0.9 + 0.15 * max(c, 0.0) * s_i * s_o / max(wi[2], wo[2]))
