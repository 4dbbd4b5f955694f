"""What a reference returns, and how the rounding of a closed form is bounded."""

from typing import NamedTuple

EPSILON = 2.0**-52


class Truth(NamedTuple):
    """A true value with a bound on its absolute error, what kind of truth it is and its source."""

    value: float
    error: float
    kind: str
    source: str


def closed_form(value: float, source: str, *, terms: float = 0.0, condition: float = 1.0) -> Truth:
    """Truth of a formula evaluated in double precision.

    `terms` is the sum of the magnitudes that were added up (where it exceeds the value, digits
    cancel) and `condition` the relative change of the value per relative change of cos theta:
    the cosine is itself a rounded number. Sixteen half-roundings cover the longest formula here.
    """
    error = EPSILON * (8.0 + condition) * max(abs(value), terms)
    return Truth(value, error, "closed form", source)


def sine(mu: float) -> float:
    """sin theta from cos theta, to full relative accuracy also towards the normal."""
    return float(((1.0 - mu) * (1.0 + mu)) ** 0.5)
