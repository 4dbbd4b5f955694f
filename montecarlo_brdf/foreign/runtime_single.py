"""What GLSL's functions are in single precision: every operation is rounded as a shader's is."""

from __future__ import annotations

import math
from math import (
    acos,
    acosh,
    asin,
    asinh,
    atan,
    atan2,
    atanh,
    cos,
    cosh,
    exp,
    log,
    log2,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
)

from numpy import float32 as F

from montecarlo_brdf.foreign import runtime
from montecarlo_brdf.foreign.runtime import quotient, rest, signed, whole_sign

__all__ = [
    "INF", "NAN", "F", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "bits_to_float",
    "clamp", "cos", "cosh", "degrees", "exp", "exp2", "float_to_bits", "inverse_root", "log",
    "log2", "lower", "mix", "modulo", "nearest", "power", "quotient", "radians", "remainder",
    "rest", "sign", "signed", "sin", "sinh", "smoothstep", "sqrt", "step", "tan", "tanh",
    "truncated", "whole", "whole_sign",
]  # fmt: skip

STRICT = True  # compiled without any rewriting
INF = F(math.inf)
NAN = F(math.nan)
LARGE = F(8388608.0)  # 2^23: every float from here on is whole
WORD = F(4294967296.0)  # 2^32


def exp2(x: F) -> F:
    """2^x."""
    return F(2.0) ** x


def power(x: F, y: F) -> F:
    """x^y, NaN for x < 0."""
    return NAN if x < F(0.0) else x**y


def inverse_root(x: F) -> F:
    """1/sqrt(x)."""
    return F(1.0) / sqrt(x)


def mix(x: F, y: F, k: F) -> F:
    """From x at k = 0 to y at k = 1."""
    return x * (F(1.0) - k) + y * k


def clamp(x: F, low: F, high: F) -> F:
    """min(max(x, low), high)."""
    y = low if x < low else x
    return high if high < y else y


def step(edge: F, x: F) -> F:
    """0 below the edge, else 1."""
    return F(0.0) if x < edge else F(1.0)


def smoothstep(low: F, high: F, x: F) -> F:
    """From 0 to 1 between two edges."""
    t = clamp((x - low) / (high - low), F(0.0), F(1.0))
    return t * t * (F(3.0) - F(2.0) * t)


def sign(x: F) -> F:
    """-1, 0 or 1."""
    return F(1.0) if x > F(0.0) else (F(-1.0) if x < F(0.0) else F(0.0))


def radians(x: F) -> F:
    """Degrees as radians."""
    return x * F(0.017453292519943295)


def degrees(x: F) -> F:
    """Radians as degrees."""
    return x * F(57.29577951308232)


def lower(x: F) -> F:
    """The largest whole number that is not above x."""
    return F(math.floor(x)) if abs(x) < LARGE else x


def truncated(x: F) -> F:
    """x without its fraction."""
    return -lower(-x) if x < F(0.0) else lower(x)


def nearest(x: F) -> F:
    """The nearest whole number; of two that are as near, the even one."""
    return F(runtime.nearest(float(x)))


def modulo(x: F, y: F) -> F:
    """x - y floor(x/y)."""
    return x - y * lower(x / y)


def remainder(x: F, y: F) -> F:
    """x - y trunc(x/y)."""
    return x - y * truncated(x / y)


def whole(x: F) -> int:
    """x without its fraction as a whole number; of what has none, the lowest."""
    return int(x) if abs(x) < WORD else -2147483648


def float_to_bits(x: F) -> int:
    """The bits of a float."""
    return runtime.float_to_bits(float(x))


def bits_to_float(bits: int) -> F:
    """The float that has these bits."""
    return F(runtime.bits_to_float(bits))
