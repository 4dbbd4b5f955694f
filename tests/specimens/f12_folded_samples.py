"""Failure 12. abs() turns samples from below the horizon up again; the pdf does not know."""

from montecarlo_brdf.models import phong
from montecarlo_brdf.models.phong import Params, domain, f, pdf  # noqa: F401

found_by = ("run", "sampling")
draw = phong.sample


def sample(wo, u, p):
    w = draw(wo, u, p)
    return w[0], w[1], abs(w[2])
