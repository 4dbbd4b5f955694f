"""Where two values of f that should be equal differ most, beyond what rounding explains."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import directions
from montecarlo_brdf.cases.look import Look

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Index, Pairs

#: values below this share of the largest are rounding
NEGLIGIBLE = 1e-25


def relative(one: Array, other: Array, share: float = NEGLIGIBLE) -> Array:
    """|f - f'|/max(f, f'), values below a `share` of the largest being held against that; 0 where
    one of the two is not finite, which is positivity's business."""
    usable = np.isfinite(one) & np.isfinite(other)
    one, other = np.where(usable, one, 0.0), np.where(usable, other, 0.0)
    high = np.maximum(np.abs(one), np.abs(other))
    floor = max(share * float(high.max(initial=0.0)), 1e-300)
    found: Array = np.abs(one - other) / np.maximum(high, floor)
    return found


def worst(
    at: Look, other: Array, pair: Pairs, share: float = NEGLIGIBLE, tolerance: float = 1e-6
) -> tuple[int, float]:
    """The point where f differs most from what it should be, and how much, relatively and beyond
    what rounding explains; other: what it should be; pair: the directions which that is from."""
    deviation = relative(at.f, other, share)
    if deviation.max(initial=0.0) > tolerance:

        def f(index: Index, wo: Array, wi: Array) -> Array:
            return at.values(at.model.f, wo, wi, index)

        places = (at.points.wo, at.points.wi), pair
        rng = at.case.random("rounding")
        deviation = directions.unexplained(
            deviation, np.abs(at.f - other), tolerance, f, places, rng
        )
    k = int(np.argmax(deviation))
    return k, float(deviation[k])
