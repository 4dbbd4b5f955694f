"""Elementary functions as branch-free polynomials, for inner loops.

A call to libm keeps a numba loop scalar (10 to 40 ns); these inline and vectorise (about 1 ns).
Choices are conditional expressions, which become masks; a NaN that goes in comes out again. The
compiler may reassociate sums: no function here relies on (a + b) - b.
Coefficients: scripts/polynomials.py prints them with the error of each fit.
"""
from __future__ import annotations

import math

from montecarlo_brdf.bits import ROUNDER, ROUNDER_WORD, double_of, number_of, word_of

LOG2_E = 1.4426950408889634
LN2 = 0.6931471805599453
LN2_HIGH = 0.6931471805598903  # 42 bits: times an exponent it is exact
LN2_LOW = 5.497923018708371e-14
ABOVE_SQRT_HALF = 0x3FF0000000000000 - 0x3FE6A09E667F3BCD  # the words of 1 and of sqrt(1/2)
EXPONENT = 0x7FF0000000000000
LOWEST, HIGHEST = -1023.0, 1024.25  # exponents at which `scaled` gives 0 and infinity


def sin_half_turn(t: float) -> float:
    """sin(pi t) for |t| <= 1/2, relative error below 5e-16.

    By pairs (Estrin's scheme), as other polynomials of inner loops: a third of Horner's latency.
    """
    q = t * t
    q2 = q * q
    a = 3.141592653589793 - 5.167712780049969 * q
    b = 2.5501640398773007 - 0.5992645293189447 * q
    c = 0.0821458865731029 - 0.007370430505916944 * q
    d = 0.0004662998161898394 - 2.1903497074626018e-05 * q + 7.697826768224191e-07 * q2
    return t * ((a + b * q2) + (c + d * q2) * (q2 * q2))


def cos_half_turn(t: float) -> float:
    """cos(pi t) for |t| <= 1/2, absolute error below 3e-16."""
    q = t * t
    q2 = q * q
    a = 1.0 - 4.934802200544676 * q
    b = 4.058712126416497 - 1.335262768843447 * q
    c = 0.23533063012953284 - 0.025806888737002202 * q
    d = 0.0019295562724817132 - 0.00010456655338748738 * q + 4.149564353942586e-06 * q2
    return (a + b * q2) + (c + d * q2) * (q2 * q2)


def turn(u: float) -> tuple[float, float]:
    """(cos, sin) of the angle 2 pi (u - 1/2): u in [0, 1) runs once around, starting at -pi.

    Double angle formulas, so that both come from polynomials on half the range. (Reducing to an
    eighth of a turn by signs saves terms, but was measured slower: its selects cost more.)
    """
    t = u - 0.5
    s, c = sin_half_turn(t), cos_half_turn(t)
    return c * c - s * s, 2.0 * s * c


def clamped(t: float, low: float, high: float) -> float:
    """t moved into [low, high]; NaN stays."""
    t = low if t < low else t
    return high if t > high else t


def nearest(t: float) -> int:
    """The integer nearest to t, |t| < 2^51."""
    return word_of(t + ROUNDER) - ROUNDER_WORD


def expm1_small(r: float) -> float:
    """e^r - 1 for |r| <= ln(2)/2."""
    r2 = r * r
    a = 0.5000000000000001 + 0.16666666666666669 * r
    b = 0.04166666666662413 + 0.008333333333330062 * r
    c = 0.0013888888917213717 + 0.00019841269863053618 * r
    d = 2.4801521295954376e-05 + 2.7557268459997064e-06 * r
    e = 2.7620088445409746e-07 + 2.510038549551032e-08 * r
    r4 = r2 * r2
    return r + r2 * ((a + b * r2) + ((c + d * r2) + e * r4) * r4)


def scaled(e: float, k: int) -> float:
    """2^k (1 + e): 0 for k = -1023, infinity for 1024; the mask only matters for a NaN's k."""
    return double_of(((k + 1023) & 0x7FF) << 52) * (1.0 + e)


def exp2(t: float) -> float:
    """2^t, relative error below 4e-16; 0 below t = -1022.5 and infinity from 1023.5."""
    t = clamped(t, LOWEST, HIGHEST)
    k = nearest(t)
    return scaled(expm1_small((t - number_of(k)) * LN2), k)


def exp_parts(x: float) -> tuple[int, float]:
    """(k, e) of e^x = 2^k (1 + e)."""
    x = clamped(x, LOWEST * LN2, HIGHEST * LN2)
    k = nearest(x * LOG2_E)
    e = expm1_small(x - number_of(k) * LN2_HIGH)
    return k, e - (1.0 + e) * (number_of(k) * LN2_LOW)


def exp(x: float) -> float:
    """e^x, relative error below 4e-16; 0 below x = -708.7 and infinity above 709.4."""
    k, e = exp_parts(x)
    return scaled(e, k)


def expm1(x: float) -> float:
    """e^x - 1 without cancellation, relative error below 6e-16."""
    k, e = exp_parts(x)
    return e if k == 0 else scaled(e, k) - 1.0


def log2_of_parts(k: int, s: float) -> float:
    """k + 2 atanh(s)/ln(2), |s| <= (sqrt(2)-1)/(sqrt(2)+1)."""
    z = s * s
    z2 = z * z
    a = 0.9617966939259756 + 0.577078016355598 * z
    b = 0.41219858310211616 + 0.3205989004205735 * z
    c = 0.2623078640447632 + 0.22197651717179587 * z
    d = 0.19142793205820974 + 0.18880010645456755 * z
    return number_of(k) + s * (2.8853900817779268 + z * ((a + b * z2) + (c + d * z2) * (z2 * z2)))


def exponent(x: float) -> int:
    """k of x = 2^k m with m in [sqrt(1/2), sqrt(2)), for normal x > 0."""
    return (((word_of(x) + ABOVE_SQRT_HALF) & EXPONENT) >> 52) - 1023


def mantissa(x: float, k: int) -> float:
    """x 2^-k; NaN and infinity stay what they are."""
    m = double_of(word_of(x) - (k << 52))
    return m if x < math.inf else x


def log2(x: float) -> float:
    """Logarithm to base 2 of normal x > 0, relative error below 5e-16."""
    k = exponent(x)
    m = mantissa(x, k)
    return log2_of_parts(k, (m - 1.0) / (m + 1.0))


def log(x: float) -> float:
    """ln x for normal x > 0, relative error below 6e-16."""
    return LN2 * log2(x)


def log2_1p(y: float) -> float:
    """log2(1 + y) for -1 < y < 1e300 without cancellation, relative error below 8e-16."""
    x = 1.0 + y
    k = exponent(x)
    m = mantissa(x, k)
    near = k == 0
    return log2_of_parts(k, (y if near else m - 1.0) / (y + 2.0 if near else m + 1.0))


def log1p(y: float) -> float:
    """ln(1 + y) without cancellation, as `log2_1p`."""
    return LN2 * log2_1p(y)


def power(x: float, n: float) -> float:
    """x^n for x > 0 and 0 for x = 0; error 4e-16 and |n ln x| roundings, the condition of x^n."""
    y = exp2(n * log2(x))
    return y if x > 0.0 else 0.0 * x


def cosine_power(d: float, n: float) -> float:
    """c^n of a cosine c = 1 - d given by d, 0 where c <= 0 (also for n = 0: half a sphere).

    Lobes of large n live at d ~ 1/n, where 1 - d has lost the digits that n multiplies. The steps
    are those of log2_1p and exp2 without what only arguments above 1 need; without the sign of x
    plain Python divides by zero nowhere.
    """
    x = abs(1.0 - d)
    k = exponent(x)
    m = double_of(word_of(x) - (k << 52))
    t = n * log2_of_parts(k, (-d if k == 0 else m - 1.0) / (m + 1.0))
    t = LOWEST if t < LOWEST else t
    j = nearest(t)
    y = scaled(expm1_small((t - number_of(j)) * LN2), j)
    return y if d < 1.0 else 0.0 * d  # a NaN is not below 1 and stays one


def asin_low(t: float) -> float:
    """asin t for |t| <= sqrt(1/2), relative error below 3e-16."""
    z = t * t
    p = 1.0656658840535 * z - 4.201910132386749
    p = ((p * z + 7.8829450923016555) * z - 9.158597380805825) * z + 7.358619925497615
    p = ((p * z - 4.297586832199172) * z + 1.8963187485717359) * z - 0.6297138419141283
    p = ((p * z + 0.17101146220020227) * z - 0.025581324215004246) * z + 0.013442391811587493
    p = ((p * z + 0.00917160999006769) * z + 0.011603298700993395) * z + 0.01396156950707128
    p = ((p * z + 0.017352910485470593) * z + 0.02237215476552006) * z + 0.03038194452250247
    p = ((p * z + 0.04464285714211393) * z + 0.0750000000000028) * z + 0.16666666666666666
    return t + t * z * p


def polar_angle(s: float, c: float) -> float:
    """The angle in [0, pi/2] whose sine is s and cosine is c, from the smaller of the two."""
    low = s < c
    angle = asin_low(s if low else c)
    return angle if low else 0.5 * math.pi - angle


def asin(x: float) -> float:
    """asin x for |x| <= 1, relative error below 5e-16."""
    angle = polar_angle(abs(x), math.sqrt((1.0 - x) * (1.0 + x)))
    return -angle if x < 0.0 else angle


def acos(x: float) -> float:
    """acos x for |x| <= 1, relative error below 5e-16: 2 asin of the half angle keeps x near 1."""
    half = asin_low(math.sqrt(0.5 * (1.0 - abs(x))))
    return math.pi - 2.0 * half if x < 0.0 else 2.0 * half
