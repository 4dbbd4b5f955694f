"""What GLSL's functions are in double precision: the names that a translated shader uses.

min, max, clamp, step and power are what GLSL's specification says, for NaN too. Whole numbers have
32 bits.
"""

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

from montecarlo_brdf.bits import double_of, word_of

__all__ = [
    "INF", "NAN", "F", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "bits_to_float",
    "clamp", "cos", "cosh", "degrees", "exp", "exp2", "float_to_bits", "inverse_root", "log",
    "log2", "lower", "mix", "modulo", "nearest", "power", "quotient", "radians", "remainder",
    "rest", "sign", "signed", "sin", "sinh", "smoothstep", "sqrt", "step", "tan", "tanh",
    "truncated", "whole", "whole_sign",
]  # fmt: skip

INF = math.inf
NAN = math.nan
LARGE = 4503599627370496.0  # 2^52: every double from here on is whole
WORD = 4294967296.0  # 2^32


def F(x: int) -> float:  # noqa: N802
    """A whole number as a double."""
    return float(x)


def exp2(x: float) -> float:
    """2^x."""
    return math.pow(2.0, x)


def power(x: float, y: float) -> float:
    """x^y, NaN for x < 0."""
    return NAN if x < 0.0 else math.pow(x, y)


def inverse_root(x: float) -> float:
    """1/sqrt(x)."""
    return 1.0 / sqrt(x)


def mix(x: float, y: float, k: float) -> float:
    """From x at k = 0 to y at k = 1."""
    return x * (1.0 - k) + y * k


def clamp(x: float, low: float, high: float) -> float:
    """min(max(x, low), high)."""
    y = low if x < low else x
    return high if high < y else y


def step(edge: float, x: float) -> float:
    """0 below the edge, else 1."""
    return 0.0 if x < edge else 1.0


def smoothstep(low: float, high: float, x: float) -> float:
    """From 0 to 1 between two edges."""
    t = clamp((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def sign(x: float) -> float:
    """-1, 0 or 1."""
    return 1.0 if x > 0.0 else (-1.0 if x < 0.0 else 0.0)


def radians(x: float) -> float:
    """Degrees as radians."""
    return x * 0.017453292519943295


def degrees(x: float) -> float:
    """Radians as degrees."""
    return x * 57.29577951308232


def lower(x: float) -> float:
    """The largest whole number that is not above x."""
    return math.floor(x) + 0.0 if abs(x) < LARGE else x


def truncated(x: float) -> float:
    """x without its fraction."""
    return -lower(-x) if x < 0.0 else lower(x)


def nearest(x: float) -> float:
    """The nearest whole number; of two that are as near, the even one."""
    low = lower(x)
    rest = x - low
    up = rest > 0.5 or (rest == 0.5 and low - 2.0 * lower(0.5 * low) == 1.0)
    return low + 1.0 if up else low


def modulo(x: float, y: float) -> float:
    """x - y floor(x/y)."""
    return x - y * lower(x / y)


def remainder(x: float, y: float) -> float:
    """x - y trunc(x/y)."""
    return x - y * truncated(x / y)


def whole(x: float) -> int:
    """x without its fraction as a whole number; of what has none, the lowest."""
    return int(x) if abs(x) < WORD else -2147483648


def whole_sign(x: int) -> int:
    """-1, 0 or 1."""
    return 1 if x > 0 else (-1 if x < 0 else 0)


def signed(x: int) -> int:
    """x modulo 2^32, from -2^31."""
    return ((x + 0x80000000) & 0xFFFFFFFF) - 0x80000000


def quotient(a: int, b: int) -> int:
    """a/b without its fraction; 0 for b = 0."""
    if b == 0:
        return 0
    return abs(a) // abs(b) if (a < 0) == (b < 0) else -(abs(a) // abs(b))


def rest(a: int, b: int) -> int:
    """a modulo b with the sign of b; 0 for b = 0."""
    return a - b * (a // b) if b != 0 else 0


def float_to_bits(x: float) -> int:
    """The bits of the float nearest to x; 0 for what is too small, infinite for too large."""
    word = word_of(x)
    exponent = ((word >> 52) & 0x7FF) - 896
    rounded = (word & 0xFFFFFFFFFFFFF) + 0xFFFFFFF + ((word >> 29) & 1) >> 29
    bits = (exponent << 23) + rounded
    bits = 0 if exponent <= 0 else (0x7F800000 if bits > 0x7F800000 else bits)
    return bits | (0x80000000 if word < 0 else 0)


def bits_to_float(bits: int) -> float:
    """The float that has these bits; 0 for those below the normal ones."""
    exponent = (bits >> 23) & 0xFF
    if exponent == 0:
        return 0.0
    high = 0x7FF if exponent == 0xFF else exponent + 896
    sign = (bits >> 31) & 1
    return double_of((sign << 63) | (high << 52) | ((bits & 0x7FFFFF) << 29))
