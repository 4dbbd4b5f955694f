"""Failure 28. 1 - (n.h)^2 cancels: GGX as printed loses its highlight in single precision."""

from montecarlo_brdf.stability.specimens.textbook_ggx import Params, domain, f, lobe  # noqa: F401

found_by = ("stress", "float32")
