"""A function of numbers in one precision, for tests of single formulas."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from montecarlo_brdf.stability.arithmetic import Arithmetic
from montecarlo_brdf.stability.batch import over_points
from montecarlo_brdf.stability.elementary import Rebound


def in_precision(function: Callable[..., Any], arithmetic: Arithmetic, *columns: Any) -> Any:
    """The function, applied to columns of numbers in a precision."""
    rounded = tuple(arithmetic.array(c) for c in columns)
    return over_points(rounded, Rebound(arithmetic).clone(function, {}), arithmetic)[0]
