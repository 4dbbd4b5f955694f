"""Failure 29. + 1e-6 in the denominator of D."""

from montecarlo_brdf.stability.specimens.biased_ggx import (  # noqa: F401
    Params,
    domain,
    f,
    lobe,
    same_as,
)

found_by = ("run", "equality")
