"""Lambert with the division by pi forgotten: f = c, so A = pi c, at every angle."""

import math

from montecarlo_brdf.references._truth import Truth, closed_form

RECIPROCAL = True
SOURCE = "A = pi c"


def albedo(cos_theta_o: float, *, c: float) -> Truth:
    return closed_form(math.pi * c, SOURCE)


def bihemispherical(*, c: float) -> Truth:
    return closed_form(math.pi * c, SOURCE)
