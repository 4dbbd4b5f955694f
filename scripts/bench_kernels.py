"""How fast the kernels are, as ratios of times taken alternately in one run on one core.

The integrand f = (1 + 0.3x + 0.2y + 0.1xy)/pi needs both coordinates, so that nothing folds away;
mean and spread are accumulated over the full azimuth. Run: python scripts/bench_kernels.py [FILE]
with FILE for a record in JSON; the exit code is 1 if a bound is missed. Ratios are of the fastest
times, which other load on the machine disturbs least; that of two variants of one loop, close to 1,
is the median of 21 interleaved pairs.
"""
from __future__ import annotations

import ctypes
import json
import math
import os
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numba
import numpy as np
from environment import describe

from montecarlo_brdf.bits import u64
from montecarlo_brdf.compile import kernel, native
from montecarlo_brdf.compile.bind import hole
from montecarlo_brdf.compile.layout import Layout, Unpack, pack
from montecarlo_brdf.estimate import moments
from montecarlo_brdf.estimate.quantity import Quantity, integrand
from montecarlo_brdf.sampling import points
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import NONE, replicate_key

COUNT = 1 << 17
PAIRS = 21
REPEATS = 15  # calls in one measurement: the fastest of them counts

#: ratio -> its bound
BOUNDS = {
    "plain loop / kernel, at least": 15.0,
    "kernel / two square roots, at most": 1.5,
    "kernel / one running sum, at most": 1.15,
}

INTEGRAND: Any = hole()
PARAMETERS: Any = hole()
Timed = Callable[[], None]


class Params(NamedTuple):
    a: float = 0.3
    b: float = 0.2
    c: float = 0.1


def f(wo: Any, wi: Any, p: Any) -> float:
    return (1.0 + p.a * wi[0] + p.b * wi[1] + p.c * wi[0] * wi[1]) / math.pi


@numba.njit
def plain_loop(count: int, a: float, b: float, c: float) -> tuple[float, float]:
    """What most people write."""
    mean = squares = 0.0
    for i in range(count):
        u1, u2 = np.random.random(), np.random.random()
        r, phi = math.sqrt(u1), 2.0 * math.pi * u2
        x, y = r * math.cos(phi), r * math.sin(phi)
        value = (1.0 + a * x + b * y + c * x * y) / math.pi * math.pi
        delta = value - mean
        mean += delta / (i + 1)
        squares += delta * (value - mean)
    return mean, squares


@numba.njit(fastmath=True)
def two_roots(count: int, a: float, b: float) -> float:
    """Calibration: what the square-root unit allows for one cosine-weighted direction."""
    s = t = 0.0
    for i in range(count):
        s += math.sqrt(a + i)
        t += math.sqrt(b + i)
    return s + t


def running_sum(ints: Any, reals: Any, out: Any) -> None:
    """The kernel's loop with one running sum and sum of squares instead of merged blocks."""
    query = (reals[0], reals[1], reals[2], reals[3])
    p = PARAMETERS(reals)
    key = replicate_key(u64(ints[0]), ints[1])
    total = squares = 0.0
    for i in range(ints[4]):
        x = INTEGRAND(points.independent(key, u64(i)), query, p[0])
        total += x
        squares += x * x
    out[1] = total / ints[4]
    out[2] = squares - total * total / ints[4]


def layout_of(channels: int) -> tuple[Layout, list[float]]:
    return pack([Params(a=0.3 + 0.01 * k) for k in range(channels)], moments.QUERY)


def ours(point_set: str, channels: int = 1) -> Timed:
    """The real kernel."""
    layout, numbers = layout_of(channels)
    mean = integrand(Quantity.ALBEDO, Sampler.COSINE, {"F": f})
    return call(moments.kernel_of("", point_set, [mean], layout).entry, numbers, channels)


def simplest() -> Timed:
    """`running_sum`, compiled as kernels are."""
    layout, numbers = layout_of(1)
    mean = integrand(Quantity.ALBEDO, Sampler.COSINE, {"F": f}).template
    made = kernel.kernel("", running_sum, INTEGRAND=mean, PARAMETERS=Unpack(layout))
    return call(made.entry, numbers, 1)


def call(entry: native.Entry, numbers: list[float], channels: int) -> Timed:
    """A call without arguments, so that nothing but the kernel is timed."""
    ints = (ctypes.c_int64 * 10)(1, 0, 1, 0, COUNT, *NONE)
    reals = (ctypes.c_double * (4 + len(numbers)))(0.6, 0.0, 0.8, 0.0, *numbers)
    out = (ctypes.c_double * (moments.STATE * channels))()

    def timed() -> None:
        ctypes.memset(out, 0, ctypes.sizeof(out))
        entry(*map(ctypes.addressof, (ints, reals, out)))

    timed()
    assert abs(out[1] - 1.0) < 0.01, "the kernel does not integrate this f"
    return timed


def seconds(timed: Timed) -> float:
    """The fastest of some calls."""
    best = math.inf
    for _ in range(REPEATS):
        start = time.perf_counter()
        timed()
        best = min(best, time.perf_counter() - start)
    return best


def measure(cases: dict[str, Timed]) -> dict[str, list[float]]:
    """Times of all cases, taken in turns so that a change of the clock meets all of them."""
    times: dict[str, list[float]] = {name: [] for name in cases}
    for _ in range(PAIRS):
        for name, timed in cases.items():
            times[name].append(seconds(timed))
    return times


def main(record: str | None) -> int:
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    cases: dict[str, Timed] = {
        "plain loop": lambda: plain_loop(COUNT, 0.3, 0.2, 0.1),
        "two square roots": lambda: two_roots(COUNT, 1.0, 2.0),
        "one running sum": simplest(),
        "kernel": ours("independent"),
        "kernel, 3 channels": ours("independent", 3),
        "kernel, Sobol": ours("sobol"),
        "kernel, Sobol, 3 channels": ours("sobol", 3),
    }
    for timed in cases.values():
        timed()
    times = measure(cases)
    nanoseconds = {name: 1e9 * min(row) / COUNT for name, row in times.items()}
    for name, value in nanoseconds.items():
        print(f"{name:28} {value:7.3f} ns per sample")
    ratios, failed = {}, 0
    for label, bound in BOUNDS.items():
        above, below = label.split(",")[0].split(" / ")
        pairs = [a / b for a, b in zip(times[above], times[below], strict=True)]
        fastest = min(times[above]) / min(times[below])
        ratio = statistics.median(pairs) if "running" in label else fastest
        holds = ratio >= bound if label.endswith("at least") else ratio <= bound
        failed += not holds
        ratios[label] = {"ratio": round(ratio, 3), "bound": bound, "holds": holds}
        print(f"{label:40} {bound:5.2f}: {ratio:6.2f} {'ok' if holds else 'MISSED'}")
    if record:
        found = {**describe(), "ratios": ratios, "nanoseconds": nanoseconds}
        with open(record, "w", encoding="utf-8") as file:
            json.dump(found, file, indent=1)
            file.write("\n")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:2] or [None]))
