"""What GLSL's functions are: the names that a translated shader uses.

min, max, clamp, step and power are what GLSL's specification says, for NaN too. Whole numbers have
32 bits. A number is written F(0.5): a double here, a float32 in `runtime_single`, which has the
same functions.
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
    "INF", "NAN", "F", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh",
    "binary_exponent", "bit_count", "bits_to_float", "clamp", "cos", "cosh", "degrees", "exp",
    "exp2", "field", "float_to_bits", "high_word", "highest_bit", "inverse_root", "log", "log2",
    "lower", "lowest_bit", "mix", "modulo", "nearest", "power", "quotient", "radians", "remainder",
    "rest", "reversed_bits", "scaled", "sign", "signed", "signed_field", "sin", "sinh",
    "smoothstep", "sqrt", "step", "tan", "tanh", "truncated", "whole", "whole_sign", "with_field",
]  # fmt: skip

INF = math.inf
NAN = math.nan
LARGE = 4503599627370496.0  # 2^52: every double from here on is whole


def F(x: float) -> float:  # noqa: N802
    """A number as the shader's are."""
    return float(x)


def exp2(x: float) -> float:
    """2^x."""
    found: float = F(2.0) ** x
    return found


def power(x: float, y: float) -> float:
    """x^y, NaN for x < 0."""
    return NAN if x < F(0.0) else x**y


def inverse_root(x: float) -> float:
    """1/sqrt(x)."""
    return F(1.0) / sqrt(x)


def mix(x: float, y: float, k: float) -> float:
    """From x at k = 0 to y at k = 1."""
    return x * (F(1.0) - k) + y * k


def clamp(x: float, low: float, high: float) -> float:
    """min(max(x, low), high)."""
    y = low if x < low else x
    return high if high < y else y


def step(edge: float, x: float) -> float:
    """0 below the edge, else 1."""
    return F(0.0) if x < edge else F(1.0)


def smoothstep(low: float, high: float, x: float) -> float:
    """From 0 to 1 between two edges."""
    t = clamp((x - low) / (high - low), F(0.0), F(1.0))
    return t * t * (F(3.0) - F(2.0) * t)


def sign(x: float) -> float:
    """-1, 0 or 1."""
    return F(1.0) if x > F(0.0) else (F(-1.0) if x < F(0.0) else F(0.0))


def radians(x: float) -> float:
    """Degrees as radians."""
    return x * F(0.017453292519943295)


def degrees(x: float) -> float:
    """Radians as degrees."""
    return x * F(57.29577951308232)


def lower(x: float) -> float:
    """The largest whole number that is not above x."""
    return F(math.floor(x)) if abs(x) < LARGE else x


def truncated(x: float) -> float:
    """x without its fraction."""
    return -lower(-x) if x < F(0.0) else lower(x)


def nearest(x: float) -> float:
    """The nearest whole number; of two that are as near, the even one."""
    low = lower(x)
    rest = x - low
    odd = low - F(2.0) * lower(F(0.5) * low) == F(1.0)
    return low + F(1.0) if rest > F(0.5) or (rest == F(0.5) and odd) else low


def modulo(x: float, y: float) -> float:
    """x - y floor(x/y)."""
    return x - y * lower(x / y)


def remainder(x: float, y: float) -> float:
    """x - y trunc(x/y)."""
    return x - y * truncated(x / y)


def whole(x: float) -> int:
    """x without its fraction as a whole number; of what has none, the lowest."""
    return int(x) if abs(x) < F(4294967296.0) else -2147483648


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


def high_word(a: int, b: int) -> int:
    """The upper 32 bits of a product of two words."""
    return ((a >> 16) * b + ((a & 0xFFFF) * b >> 16)) >> 16


def field(x: int, first: int, count: int) -> int:
    """Some bits of a word."""
    return (x & 0xFFFFFFFF) >> first & ((1 << count) - 1)


def signed_field(x: int, first: int, count: int) -> int:
    """The same, the uppermost of them a sign."""
    half = (1 << count) >> 1
    return ((field(x, first, count) + half) & ((1 << count) - 1)) - half


def with_field(x: int, new: int, first: int, count: int) -> int:
    """The word with some bits of it replaced."""
    mask = ((1 << count) - 1) << first
    return (x & ~mask) | ((new << first) & mask)


def reversed_bits(x: int) -> int:
    """The bits of a word in the other order."""
    found = 0
    for k in range(32):
        found |= ((x >> k) & 1) << (31 - k)
    return found


def bit_count(x: int) -> int:
    """How many bits of a word are set."""
    found = 0
    for k in range(32):
        found += (x >> k) & 1
    return found


def lowest_bit(x: int) -> int:
    """The place of the lowest bit that is set, -1 for 0."""
    found = -1
    for k in range(31, -1, -1):
        found = k if (x >> k) & 1 else found
    return found


def highest_bit(x: int) -> int:
    """The place of the highest bit that is set, -1 for 0; of x < 0, of the highest that is not."""
    x = ~x if x < 0 else x
    found = -1
    for k in range(32):
        found = k if (x >> k) & 1 else found
    return found


def binary_exponent(x: float) -> int:
    """e of x = m 2^e with |m| in [1/2, 1); 0 for 0."""
    bits = (word_of(float(x)) >> 52) & 0x7FF
    return bits - 1022 if 0 < bits < 0x7FF else 0


def scaled(x: float, e: int) -> float:
    """x 2^e."""
    return x * exp2(F(e))


def float_to_bits(x: float) -> int:
    """The bits of the float nearest to x; 0 for what is too small, infinite for too large."""
    word = word_of(float(x))
    exponent = ((word >> 52) & 0x7FF) - 896
    rounded = (word & 0xFFFFFFFFFFFFF) + 0xFFFFFFF + ((word >> 29) & 1) >> 29
    bits = (exponent << 23) + rounded
    bits = 0 if exponent <= 0 else (0x7F800000 if bits > 0x7F800000 else bits)
    return bits | (0x80000000 if word < 0 else 0)


def bits_to_float(bits: int) -> float:
    """The float that has these bits; 0 for those below the normal ones."""
    exponent = (bits >> 23) & 0xFF
    if exponent == 0:
        return F(0.0)
    high = 0x7FF if exponent == 0xFF else exponent + 896
    sign = (bits >> 31) & 1
    return F(double_of((sign << 63) | (high << 52) | ((bits & 0x7FFFFF) << 29)))
