"""Estimates with their error bars.

An estimate comes from R replicates, independent randomisations of a point set: the spread of
their means is an honest error bar for any point set, and standardised errors follow Student's t
with R - 1 degrees of freedom (never a normal).
"""
from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import NamedTuple

#: No error bar is smaller than rounding: 4 units of the last place of the mean.
FLOOR = 4.0 * 2.0**-52
#: Characters of an estimate: 17 digits and what stands around them.
LONGEST = 24
#: Digits of an estimate that is exact to rounding.
EXACT = 8
#: What is smaller is printed with an exponent, as bounds and tolerances are.
SMALL = 1e-4
#: Values that differ by less than this, relative to their mean, are one value and its rounding.
SAME = 1e-12
#: Draws that differ from the others by their own size, but are fewer than this in a sample, are too
#: few to tell how often they occur: no error bar is then smaller than HIDDEN of them, so that t
#: times the bar is at least log(1/level) of them at levels down to 10^-11.
FEW = 16.0
HIDDEN = 3.5


class Moments(NamedTuple):
    """Count, mean, sum of squared deviations and largest value of some samples."""

    count: float  # type: ignore[assignment]  # hides tuple.count
    mean: float
    squares: float
    largest: float


class Estimate(NamedTuple):
    """An estimated mean with its standard error; prints as 0.68899(76)."""

    mean: float
    stderr: float
    samples: int
    replicates: tuple[float, ...]  # their means
    second_moment: float  # mean of x^2 over all samples
    largest: float  # largest sample
    method: str = ""  # how it was estimated and why so, where that was chosen

    @property
    def dof(self) -> int:
        """Degrees of freedom of the error bar."""
        return len(self.replicates) - 1

    def half_width(self, level: float) -> float:
        """Half the width of the interval that misses the truth with probability `level`."""
        return quantile(level / 2.0, self.dof) * self.stderr if self.dof > 0 else math.inf

    def effective_samples(self) -> float:
        """Kish's effective sample size, N mean^2 / E[x^2]."""
        square = self.mean * self.mean
        return self.samples * square / self.second_moment if self.second_moment else 0.0

    def times(self, factor: float) -> Estimate:
        """The estimate of `factor` > 0 times the mean."""
        return self._replace(
            mean=factor * self.mean,
            stderr=factor * self.stderr,
            replicates=tuple(factor * m for m in self.replicates),
            second_moment=factor * factor * self.second_moment,
            largest=factor * self.largest,
        )

    def __str__(self) -> str:
        return with_error(self.mean, self.stderr)


def with_error(value: float, error: float) -> str:
    """'0.68899(76)': the digits in brackets are the standard error of the last digits shown; just
    the value where nothing is known about its error.

    '0.8(0)': exact to rounding, as the error is at most `FLOOR`. '6.8899(76)e-30': what is small or
    would be longer than a column can hold.
    """
    if not (math.isfinite(value) and math.isfinite(error)):
        return f"{value:.6g}"
    if error <= FLOOR * abs(value):
        return f"{value:.{EXACT if abs(value) >= SMALL else 2}g}(0)"
    text = _with_digits(value, error)
    if len(text) <= LONGEST and (max(abs(value), error) >= SMALL or not value):
        return text
    power = int(f"{max(abs(value), error):e}".partition("e")[2])
    return f"{_with_digits(_shifted(value, power), _shifted(error, power))}e{power:+03d}"


def _with_digits(value: float, error: float) -> str:
    mantissa, exponent = f"{error:.1e}".split("e")
    places = max(0, 1 - int(exponent))
    shown = mantissa.replace(".", "") if places else f"{error:.0f}"
    return f"{value:.{places}f}({shown})"


def _shifted(value: float, power: int) -> float:
    """value/10^power, where either may be near the ends of the numbers."""
    mantissa, exponent = f"{value:.16e}".split("e")
    return float(f"{mantissa}e{int(exponent) - power}")


def merged(parts: Sequence[Moments]) -> Moments:
    """Moments of all samples together, merged pairwise so that rounding does not build up."""
    while len(parts) > 1:
        pairs = [_pair(*parts[i : i + 2]) for i in range(0, len(parts) - 1, 2)]
        parts = pairs + ([parts[-1]] if len(parts) % 2 else [])
    return parts[0]


def _pair(a: Moments, b: Moments) -> Moments:
    """Chan, Golub, LeVeque 1979, the update formula for pairs."""
    count = a.count + b.count
    shift = b.mean - a.mean
    return Moments(
        count,
        a.mean + shift * (b.count / count),
        a.squares + b.squares + shift * shift * (a.count * b.count / count),
        max(a.largest, b.largest),
    )


def estimate(replicates: Sequence[Moments]) -> Estimate:
    """The mean over equally large replicates and the standard error from their spread."""
    return _estimate(list(zip(*replicates, strict=True)))


def estimates_of(states: Sequence[float], width: int, method: str = "") -> list[Estimate]:
    """The same for `width` results, whose moments stand side by side for each replicate."""
    fields, stride = len(Moments._fields), len(Moments._fields) * width
    return [
        _estimate([tuple(states[fields * k + i :: stride]) for i in range(fields)], method)
        for k in range(width)
    ]


def _estimate(columns: Sequence[tuple[float, ...]], method: str = "") -> Estimate:
    """`columns`: the fields of Moments, one number per replicate each."""
    counts, means, squares, largest = columns
    count, each = len(means), counts[0]
    total = sum(means)
    if not math.isfinite(total):
        nan = math.nan
        return Estimate(nan, nan, int(count * each), means, nan, max(largest), method)
    mean = math.fsum(means) / count
    spread = _sum([(m - mean) * (m - mean) for m in means])
    stderr = math.sqrt(spread / (count * (count - 1))) if count > 1 else math.inf
    variance = _sum(squares) / (count * each) + spread / count
    return Estimate(
        mean,
        max(stderr, least_error(mean, variance, count * each)),
        int(count * each),
        means,
        variance + mean * mean,
        max(largest),
        method,
    )


def _sum(squares: Sequence[float]) -> float:
    """Exactly rounded; infinite where numbers end."""
    try:
        return math.fsum(squares)
    except (OverflowError, ValueError):  # the second is infinity less infinity
        return math.inf


def least_error(mean: float, variance: float, samples: float) -> float:
    """What no error bar of samples with this mean and variance may go below.

    Rounding; and, where values hardly differ but do, what may hide from so few (`hidden_error`).
    Equal values hide nothing that any sampling could show: they keep the rounding floor.
    """
    rounding = FLOOR * abs(mean)
    if variance <= SAME**2 * mean * mean:
        return rounding
    return max(rounding, hidden_error(abs(mean), variance, samples))


def hidden_error(size: float, variance: float, samples: float) -> float:
    """What events of some size may add to an error while they are too rare to be drawn; 0 where
    the values vary enough to have shown them.

    Importance sampling of a lobe with a long thin tail gives nearly equal weights and, once in 10^6
    draws, a weight of 0. An event of probability p stays unseen with probability exp(-p samples),
    so a mean may be off by its size times log(1/level)/samples.
    """
    return HIDDEN * size / samples if variance < FEW * size * size / samples else 0.0


# Student's t distribution, without the import of scipy.stats (2 s) that a CLI would feel ----------


def tail(t: float, dof: int) -> float:
    """P(T > t) for t >= 0, Student's t; relative accuracy about 1e-13 however small the tail.

    Source: I_x(dof/2, 1/2)/2 with x = dof/(dof + t^2), regularised incomplete beta by Lentz's
    continued fraction (DLMF 8.17.22).
    """
    q = t * t / dof
    if t <= 0.0 or q == 0.0:
        return 0.5
    if q == math.inf:
        return 0.0
    a, b = dof / 2, 0.5
    x, y = 1.0 / (1.0 + q), q / (1.0 + q)  # y = 1 - x, also where x rounds to 1
    beta = math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)
    front = math.exp(b * math.log(y) - a * math.log1p(q) - beta)
    if x < (a + 1) / (a + b + 2):
        return 0.5 * front * _fraction(x, a, b) / a
    return 0.5 * (1.0 - front * _fraction(y, b, a) / b)


def _fraction(x: float, a: float, b: float) -> float:
    """The continued fraction of I_x(a, b)."""
    c, d = 1.0, 1.0 / (1.0 - (a + b) * x / (a + 1.0))
    value = d
    for m in range(1, 500):
        for even in (True, False):
            if even:
                term = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
            else:
                term = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
            d = 1.0 / (1.0 + term * d)
            c = 1.0 + term / c
            value *= c * d
        if abs(c * d - 1.0) < 1e-15:
            break
    return value


@functools.cache
def quantile(upper: float, dof: int) -> float:
    """The t >= 0 that is exceeded with probability `upper` (0 < upper <= 1/2)."""
    if upper >= 0.5 or dof < 1:
        return 0.0 if upper >= 0.5 else math.inf
    low, high = 0.0, 2.0
    while tail(high, dof) > upper:
        low, high = high, high * 2.0
    while high - low > 1e-12 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if tail(middle, dof) > upper else (low, middle)
    return high
