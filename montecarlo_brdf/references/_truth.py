"""What a reference returns, and how the rounding of a closed form is bounded."""

from collections.abc import Callable
from typing import NamedTuple

EPSILON = 2.0**-52


class Truth(NamedTuple):
    """A true value with a bound on its absolute error, what kind of truth it is and its source."""

    value: float
    error: float
    kind: str
    source: str


class Albedos(NamedTuple):
    """The truth about one model, as functions of a cosine and of parameters and choices by name."""

    albedo: Callable[..., Truth]  # A(theta_o) of cos(theta_o)
    bihemispherical: Callable[..., Truth]  # 2 * integral of A(mu) mu dmu, without a cosine
    reverse_albedo: Callable[..., Truth] | None = None  # R(theta_i); None: f is reciprocal, R = A


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
