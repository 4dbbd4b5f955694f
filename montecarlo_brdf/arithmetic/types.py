"""The number types of the ladder, from half precision to 50 digits."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from montecarlo_brdf.errors import UserError, unknown

DIGITS = 50
#: Relative error of f that is allowed by default: 84 roundings in single and 450 in double, about a
#: hundred in half. Constants of a source are doubles: long double can promise no more than double.
TOLERANCES = {
    "bfloat16": 0.5, "float16": 0.1, "float32": 1e-5, "float64": 1e-13, "longdouble": 1e-13,
}  # fmt: skip
#: numbers of the type under test
Array = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Arithmetic:
    """A number type: its limits, and its operations where they are not NumPy's own."""

    name: str
    dtype: Any
    eps: float  # spacing of the numbers just above 1
    tiny: float  # smallest normal number
    least: float  # smallest number
    most: float  # largest number, in a double if it fits
    tolerance: float  # relative error that is allowed by default
    functions: Mapping[str, Callable[..., Any]]
    convert: Callable[[Any], Any] | None = None
    #: is told which points the next run of a function is for
    watch: Callable[[Array], None] | None = None

    def __repr__(self) -> str:
        return self.name

    def array(self, values: ArrayLike) -> Array:
        """Numbers rounded to this type."""
        values = np.asarray(values)
        if values.dtype == self.dtype:
            return values
        if self.convert:
            return np.asarray(np.frompyfunc(self.convert, 1, 1)(values), dtype=object)
        with np.errstate(all="ignore"):
            return values.astype(self.dtype)

    def number(self, value: float) -> Any:
        """A double rounded to this type."""
        return (self.convert or self.dtype.type)(value)

    def function(self, name: str) -> Callable[..., Any]:
        """The operation `name` of this type: NumPy's unless it has its own."""
        return self.functions.get(name) or getattr(np, name)


def _float(name: str, dtype: DTypeLike | None = None, info: Any = None) -> Arithmetic:
    dtype = np.dtype(dtype or name)
    info = info or np.finfo(dtype)
    eps, tiny = float(info.eps), float(info.tiny)
    least, most = float(info.smallest_subnormal), float(info.max)
    return Arithmetic(name, dtype, eps, tiny, least, most, TOLERANCES[name], {})


def _bfloat16() -> Arithmetic | None:
    try:
        import ml_dtypes
    except ImportError:
        return None
    info = ml_dtypes.finfo(ml_dtypes.bfloat16)
    return _float("bfloat16", ml_dtypes.bfloat16, info)


@functools.cache
def ladder() -> dict[str, Arithmetic]:
    """All types of this machine by name, the narrowest first."""
    found = [_bfloat16(), *map(_float, ("float16", "float32", "float64"))]
    if np.finfo(np.longdouble).eps < np.finfo(np.float64).eps:  # on some machines they are the same
        found.append(_float("longdouble", np.longdouble))
    return {one.name: one for one in found if one}


def precision(name: str) -> Arithmetic:
    """The type called `name`, or a UserError."""
    if name == "bfloat16" and name not in ladder():
        raise UserError("precision bfloat16 needs the package ml_dtypes: pip install ml_dtypes")
    if name not in ladder():
        raise UserError(unknown("precision", name, ladder()))
    return ladder()[name]


def wider(one: Arithmetic) -> Arithmetic:
    """The type that serves as truth for `one` at every point."""
    following = {"bfloat16": "float64", "float16": "float64", "float32": "float64"}
    name = following.get(one.name, "longdouble" if one.name == "float64" else "exact")
    return ladder().get(name) or exact()


@functools.cache
def exact() -> Arithmetic:
    """Arithmetic of 50 digits, by mpmath, on arrays of objects. Needs mpmath installed."""
    try:
        import mpmath
    except ImportError as error:
        raise UserError("the exact arithmetic of `stress` needs the package mpmath") from error

    context = mpmath.mp.clone()
    context.dps = DIGITS
    eps = float(context.eps)

    def convert(x: SupportsFloat) -> Any:
        return x if isinstance(x, context.mpf) else _exactly(context, x)

    dtype, most = np.dtype(object), float("inf")
    functions = exact_functions(context)
    return Arithmetic("exact", dtype, eps, 0.0, 0.0, most, eps, functions, convert)


def _exactly(context: Any, x: SupportsFloat) -> Any:
    """x without rounding, also a long double, which is a sum of two doubles."""
    high = float(x)
    if not isinstance(x, np.longdouble) or not np.isfinite(x):
        return context.mpf(high)
    with np.errstate(all="ignore"):
        return context.mpf(high) + context.mpf(float(x - type(x)(high)))


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
