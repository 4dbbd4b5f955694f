"""Throughput of every model: nanoseconds per cosine-sampled albedo sample, as ratios of one run.

The calibration kernel is ours with f = (1 + 0.3x + 0.2y + 0.1xy)/pi, which nothing can fold away.
All kernels are timed in turn on one core and the best of many rounds counts. The instruction mix
says how many calls, packed 512/256-bit and scalar arithmetic instructions a kernel has.

    python scripts/bench_models.py [results.json]
"""
from __future__ import annotations

import ctypes
import json
import math
import os
import re
import sys
import time
from collections.abc import Callable
from typing import Any, NamedTuple

from environment import describe

from montecarlo_brdf import load, loading
from montecarlo_brdf.compile import compiler, kernel
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate import moments
from montecarlo_brdf.estimate.quantity import Quantity, integrand
from montecarlo_brdf.model import channels
from montecarlo_brdf.sampling.directions import Sampler

SAMPLES = 1 << 17
ROUNDS = 300  # a busy neighbour takes seconds of every minute: the best of all must have missed it
#: model -> the most that its ratio to the calibration kernel may be
BOUNDS = {"oren_nayar": 1.8, "phong": 2.8, "ggx": 2.8}
COLOUR = ("ggx", {"f0": (1.0, 0.7, 0.3)}, 1.1)


class Slope(NamedTuple):
    a: float = 0.3


def calibration(wo: Any, wi: Any, p: Any) -> float:
    """An f that nothing can fold away."""
    return (1.0 + p.a * wi[0] + 0.2 * wi[1] + 0.1 * wi[0] * wi[1]) / math.pi


class Made(NamedTuple):
    """A kernel, its numbers and the parameter sets that it takes at once."""

    kernel: kernel.Kernel
    numbers: list[float]
    channels: int


def recipe(f: Callable[..., float], sets: list[Any]) -> Made:
    """The cosine-sampled albedo kernel of f."""
    layout, numbers = pack(sets, moments.QUERY)
    mean = integrand(Quantity.ALBEDO, Sampler.COSINE, {"F": f})
    made = moments.kernel_of("", "independent", [mean], layout)
    return Made(made, numbers, len(layout.places))


def prepared(name: str, **values: Any) -> Made:
    """The same for a model by name; an exponent is not a whole number."""
    model = load(name)
    names = model.Params._fields  # type: ignore[attr-defined]
    p = model.parameters(**({"n": 32.5} if "n" in names else {}), **values)
    return recipe(model.f, [model.prepared(c) for c in channels(p)])


def caller(made: Made) -> Callable[[], float]:
    """A function that runs the kernel once and returns the seconds."""
    entry, numbers = made.kernel.entry, made.numbers
    ints = (ctypes.c_int64 * 10)(12345, 0, 1, 0, SAMPLES)
    reals = (ctypes.c_double * (moments.QUERY + len(numbers)))(0.6, 0.0, 0.8, 0.0, *numbers)
    out = (ctypes.c_double * (moments.STATE * made.channels))()

    def once() -> float:
        started = time.perf_counter()
        entry(ctypes.addressof(ints), ctypes.addressof(reals), ctypes.addressof(out))
        return time.perf_counter() - started

    return once


def mix(made: Made) -> dict[str, int]:
    """Counts of instructions in the kernel's machine code."""
    text = compiler.assembly(made.kernel.module())
    return {
        "calls": len(re.findall(r"^\s+call", text, re.M)),
        "zmm": len(re.findall(r"^\s+v\w+pd.*zmm", text, re.M)),
        "scalar": len(re.findall(r"^\s+v\w+sd\s", text, re.M)),
    }


def main() -> None:
    """Time all models and print ratios."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    recipes = {"calibration": recipe(calibration, [Slope()])}
    recipes |= {name: prepared(name) for name in loading.names()}
    recipes["colour"] = prepared(COLOUR[0], **COLOUR[1])
    timers = {name: caller(r) for name, r in recipes.items()}
    best = {name: min(t() for _ in range(3)) for name, t in timers.items()}
    for _ in range(ROUNDS):
        for name, t in timers.items():
            best[name] = min(best[name], t())
    rows = {n: row(n, best, recipes[n]) for n in best}
    ratio = best["colour"] / best[COLOUR[0]]
    print(f"three channels of {COLOUR[0]} / one: {ratio:.2f} (at most {COLOUR[2]})")
    if sys.argv[1:]:
        result = {**describe(), "models": rows, "three channels / one": ratio}
        with open(sys.argv[1], "w", encoding="utf-8") as file:
            json.dump(result, file, indent=1)


def row(name: str, best: dict[str, float], made: Made) -> dict[str, Any]:
    """Print and return one model's figures."""
    ratio = best[name] / best["calibration"]
    found: dict[str, Any] = {"ns": best[name] / SAMPLES * 1e9, "ratio": ratio, **mix(made)}
    bound = f"at most {BOUNDS[name]}" if name in BOUNDS else ""
    print(
        f"{name:24} {found['ns']:7.2f} ns {ratio:6.2f} {bound:12} {found['calls']:3} calls "
        f"{found['zmm']:5} zmm {found['scalar']:5} scalar"
    )
    return found


if __name__ == "__main__":
    main()
