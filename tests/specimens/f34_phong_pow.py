"""Failure 34. pow(r.v, n): the rounding of r.v times n."""

from montecarlo_brdf.stability.specimens.textbook_phong import Params, domain, f, lobe  # noqa: F401

found_by = ("stress", "float32")
