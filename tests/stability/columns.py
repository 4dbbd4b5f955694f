"""Functions of numbers, not of directions, on the ladder of precisions."""

from collections.abc import Callable
from typing import Any

from montecarlo_brdf.arithmetic.batch import over_points
from montecarlo_brdf.arithmetic.elementary import Rebound
from montecarlo_brdf.arithmetic.types import Arithmetic


def in_precision(function: Callable[..., Any], arithmetic: Arithmetic, *columns: Any) -> Any:
    """Any function of numbers, applied to columns of numbers in a precision."""
    columns = tuple(arithmetic.array(c) for c in columns)
    return over_points(columns, Rebound(arithmetic).clone(function, {}), arithmetic)[0]
