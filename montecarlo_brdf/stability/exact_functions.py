"""Elementary functions of 50 digits, by mpmath, on arrays of objects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Function = Callable[..., Any]

#: What NumPy and mpmath call alike.
SAME = ("exp", "expm1", "sin", "cos", "tan", "sinh", "cosh", "tanh", "hypot", "erf", "erfc",
        "radians", "degrees")  # fmt: skip


def exact_functions(context: Any) -> dict[str, Function]:
    """NumPy's names for mpmath's functions, on arrays of objects, NaN where they are not real."""
    numbers = {**_own(context), **{name: getattr(context, name) for name in SAME}}
    return {
        **{name: _on_arrays(_real(context, f), object) for name, f in numbers.items()},
        **{name: _on_arrays(f, bool) for name, f in _conditions(context).items()},
    }


def _own(context: Any) -> dict[str, Function]:
    """What is called differently, or has other values at its poles."""

    def logarithm(function: Function, pole: int) -> Function:
        return lambda x: -context.inf if x == pole else function(x)

    return {
        "true_divide": _quotient(context),
        "power": lambda a, b: context.inf if a == 0 and b < 0 else a**b,
        "sqrt": context.sqrt,
        "exp2": lambda x: context.power(2, x),
        "log": logarithm(context.log, 0),
        "log2": logarithm(lambda x: context.log(x, 2), 0),
        "log10": logarithm(context.log10, 0),
        "log1p": logarithm(context.log1p, -1),
        "arcsin": context.asin, "arccos": context.acos, "arctan": context.atan,
        "arctan2": context.atan2, "floor": context.floor, "ceil": context.ceil,
        "trunc": lambda x: context.floor(x) if x >= 0 else context.ceil(x),
        "rint": context.nint,
        "copysign": lambda a, b: abs(a) if b >= 0 else -abs(a),
        "remainder": lambda a, b: a - b * context.floor(a / b),
    }  # fmt: skip


def _quotient(context: Any) -> Function:
    """a / b with IEEE's answers for b = 0."""
    nan, inf = context.nan, context.inf

    def quotient(a: Any, b: Any) -> Any:
        if b == 0:
            return nan if a == 0 or context.isnan(a) else (inf if a > 0 else -inf)
        return a / b

    return quotient


def _conditions(context: Any) -> dict[str, Function]:
    return {
        "isfinite": lambda x: bool(context.isfinite(x)),
        "isnan": lambda x: bool(context.isnan(x)),
        "isinf": lambda x: bool(context.isinf(x)),
        "less": lambda a, b: a < b, "less_equal": lambda a, b: a <= b,
        "greater": lambda a, b: a > b, "greater_equal": lambda a, b: a >= b,
        "equal": lambda a, b: a == b, "not_equal": lambda a, b: a != b,
    }  # fmt: skip


def _real(context: Any, function: Function) -> Function:
    """The function, NaN where it is complex or undefined."""

    def value(*x: Any) -> Any:
        try:
            y = function(*x)
        except (ValueError, ZeroDivisionError, OverflowError):
            return context.nan
        return context.nan if isinstance(y, context.mpc) else y

    return value


def _on_arrays(function: Function, dtype: type) -> Function:
    def applied(*operands: ArrayLike) -> Any:
        ufunc = np.frompyfunc(function, len(operands), 1)
        return np.asarray(ufunc(*operands), dtype=dtype)

    return applied
