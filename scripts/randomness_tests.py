"""Tests of 64-bit words for randomness: each takes an array of words and returns p-values.

All are two-sided: too even is as wrong as too uneven. Sources: Knuth, The Art of Computer
Programming 2, 3.3.2; Marsaglia 1985 (birthday spacings, matrix rank); L'Ecuyer, Simard 2007,
TestU01; Blackman, Vigna 2018 (dependency of Hamming weights).
"""
from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numba
import numpy as np
from scipy import stats

Words = Any
U64 = np.uint64
#: probabilities that a random 64 x 64 matrix over GF(2) has rank 64, 63 and less
RANK = (0.2887880950866, 0.5775761901732, 0.1336357147402)


def two_sided(below: float, above: float) -> float:
    return float(min(1.0, 2.0 * min(below, above)))


def chi2(counts: Any, expected: Any) -> float:
    """p-value of counts with fixed probabilities."""
    statistic = float(((counts - expected) ** 2 / expected).sum())
    law = stats.chi2(counts.size - 1)
    return two_sided(law.cdf(statistic), law.sf(statistic))


def even(cells: Any, number: int) -> float:
    """p-value of cells that are all equally likely."""
    return chi2(np.bincount(cells, minlength=number), cells.size / number)


def normal(z: float) -> float:
    return float(2.0 * stats.norm.sf(abs(z)))


def poisson(count: int, mean: float) -> float:
    return two_sided(stats.poisson.cdf(count, mean), stats.poisson.sf(count - 1, mean))


def unit(words: Words) -> Any:
    return (words >> U64(12)) * 2.0**-52 + 2.0**-53


def field(words: Words, low: int, width: int) -> Any:
    """Bits [low, low + width) as small integers."""
    return ((words >> U64(low)) & U64((1 << width) - 1)).astype(np.int64)


def bits(words: Words) -> Iterator[float]:
    """How often each bit is set."""
    z = [(2 * np.count_nonzero(words & U64(1 << b)) - words.size) for b in range(64)]
    statistic = float((np.array(z) ** 2).sum()) / words.size
    yield two_sided(stats.chi2.cdf(statistic, 64), stats.chi2.sf(statistic, 64))


def cells(words: Words) -> Iterator[float]:
    """Cells in one, two and three dimensions, of the highest and of the lowest bits."""
    for low in (0, 1):
        yield even(field(words, 0 if low else 52, 12), 1 << 12)
        for dimensions, width in ((2, 6), (3, 4)):
            whole = words[: words.size // dimensions * dimensions]
            x = field(whole, 0 if low else 64 - width, width)
            x = x.reshape(-1, dimensions) @ (1 << width * np.arange(dimensions))
            yield even(x, 1 << width * dimensions)


def serial(words: Words) -> Iterator[float]:
    """Correlation with the words 1, 2, 3, 5, 8, 16 and 1024 later."""
    x = (unit(words) - 0.5) * math.sqrt(12.0)
    for lag in (1, 2, 3, 5, 8, 16, 1024):
        yield normal(float(x[lag:] @ x[:-lag]) / math.sqrt(x.size - lag))


def runs(words: Words) -> Iterator[float]:
    """Changes of the highest, a middle and the lowest bit."""
    for b in (63, 31, 0):
        bit = field(words, b, 1)
        changes = int(np.count_nonzero(bit[1:] != bit[:-1]))
        yield normal((2 * changes - (bit.size - 1)) / math.sqrt(bit.size - 1))


def gaps(words: Words) -> Iterator[float]:
    """Distances between words whose four highest (lowest) bits are 0."""
    for low in (60, 0):
        distance = np.diff(np.flatnonzero(field(words, low, 4) == 0))
        counts = np.bincount(np.minimum(distance, 60) - 1, minlength=60)
        p = (15 / 16) ** np.arange(60) / 16
        p[-1] = (15 / 16) ** 59
        yield chi2(counts, p * distance.size)


def birthdays(words: Words) -> Iterator[float]:
    """Equal spacings of 2^12 birthdays in a year of 2^32 days: Poisson with mean 4 a year."""
    for low in (32, 0):
        days = np.sort(field(words[: words.size >> 12 << 12], low, 32).reshape(-1, 4096), axis=1)
        spacings = np.sort(np.diff(days, axis=1, prepend=0), axis=1)
        equal = int(np.count_nonzero(spacings[:, 1:] == spacings[:, :-1]))
        yield poisson(equal, 4.0 * len(days))


def collisions(words: Words) -> Iterator[float]:
    """Words that meet in 2^32 urns: the mean differs from n^2/2m by less than 1 in 1000."""
    size = min(words.size, 1 << 20)
    mean = size * (size - 1) / 2.0**33
    for low in (32, 0):
        parts = np.sort(field(words[: words.size // size * size], low, 32).reshape(-1, size))
        met = int(np.count_nonzero(parts[:, 1:] == parts[:, :-1]))
        yield poisson(met, mean * len(parts))


@numba.njit
def matrix_rank(rows: Any) -> int:
    rank = 0
    for b in range(64):
        pivot = -1
        for r in range(rank, 64):
            if rows[r] >> np.uint64(b) & np.uint64(1):
                pivot = r
                break
        if pivot < 0:
            continue
        rows[pivot], rows[rank] = rows[rank], rows[pivot]
        for r in range(rank + 1, 64):
            if rows[r] >> np.uint64(b) & np.uint64(1):
                rows[r] ^= rows[rank]
        rank += 1
    return rank


@numba.njit
def ranks(matrices: Any, counts: Any) -> None:
    for i in range(len(matrices)):
        counts[min(2, 64 - matrix_rank(matrices[i]))] += 1


def matrix(words: Words) -> Iterator[float]:
    """Rank of 64 x 64 matrices of bits, at most 2^15 of them."""
    matrices = words[: min(words.size >> 6, 1 << 15) << 6].reshape(-1, 64).copy()
    counts = np.zeros(3, np.int64)
    ranks(matrices, counts)
    yield chi2(counts, np.array(RANK) * len(matrices))


def weights(words: Words) -> Iterator[float]:
    """Hamming weights below, at and above 32 of words 1 and 2 apart, and of their differences."""
    heavy = np.sign(np.bitwise_count(words).astype(np.int64) - 32) + 1
    middle = math.comb(64, 32) / 2.0**64
    p = np.array([(1 - middle) / 2, middle, (1 - middle) / 2])
    for lag in (1, 2):
        pairs = 3 * heavy[: heavy.size // (2 * lag) * 2 * lag].reshape(-1, 2, lag)
        joint = pairs[:, 0].ravel() + pairs[:, 1].ravel() // 3
        yield chi2(np.bincount(joint, minlength=9), np.outer(p, p).ravel() * joint.size)
        flips = int(np.bitwise_count(words[lag:] ^ words[:-lag]).sum(dtype=np.int64))
        number = 64 * (words.size - lag)
        yield normal((2 * flips - number) / math.sqrt(number))


def spectrum(words: Words) -> Iterator[float]:
    """Power of the discrete Fourier transform: exponential at every frequency."""
    x = unit(words[: min(words.size, 1 << 20)]) - 0.5
    power = np.abs(np.fft.rfft(x)[1:-1]) ** 2 * (12.0 / x.size)
    yield float(stats.kstest(np.exp(-power), "uniform").pvalue)
    yield float(-np.expm1(power.size * np.log1p(-np.exp(-power.max()))))


def maxima(words: Words) -> Iterator[float]:
    """Largest of 8 in a row: its 8th power is uniform; at most 2^17 of them."""
    u = unit(words[: min(words.size >> 3, 1 << 17) << 3]).reshape(-1, 8)
    yield float(stats.kstest(u.max(axis=1) ** 8, "uniform").pvalue)


def orders(words: Words) -> Iterator[float]:
    """The order of 4 in a row."""
    x = words[: words.size >> 2 << 2].reshape(-1, 4)
    greater = [(x[:, a] > x[:, b]).astype(np.int64) for a in range(4) for b in range(a)]
    code = sum(bit << i for i, bit in enumerate(greater))
    found = np.bincount(code, minlength=64)
    possible = [c for c in range(64) if _transitive(c)]
    yield chi2(found[possible], code.size / 24)


def _transitive(code: int) -> bool:
    pairs = [(a, b) for a in range(4) for b in range(a)]
    wins = [0] * 4
    for i, (a, b) in enumerate(pairs):
        wins[a if code >> i & 1 else b] += 1
    return sorted(wins) == [0, 1, 2, 3]


Test = Callable[[Words], Iterator[float]]
TESTS: tuple[Test, ...] = (bits, cells, serial, runs, gaps, birthdays, collisions, matrix, weights,
                           spectrum, maxima, orders)  # fmt: skip
