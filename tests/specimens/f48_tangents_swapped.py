"""Failure 48. Anisotropic GGX with alpha_x and alpha_y exchanged."""

from montecarlo_brdf.models import ggx_anisotropic
from montecarlo_brdf.models.ggx_anisotropic import (  # noqa: F401
    Params,
    domain,
    isotropic,
    lobe,
)

found_by = ("run", "equality")
value = ggx_anisotropic.f
same_as = "ggx_anisotropic"


def f(wo, wi, p):
    return value((wo[1], wo[0], wo[2]), (wi[1], wi[0], wi[2]), p)
