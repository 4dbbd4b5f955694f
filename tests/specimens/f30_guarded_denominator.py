"""Failure 30. max(denominator, 0.001) removes the highlight."""

from montecarlo_brdf.stability.specimens.guarded_ggx import (  # noqa: F401
    Params,
    domain,
    f,
    lobe,
    same_as,
)

found_by = ("run", "equality")
