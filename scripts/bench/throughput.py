"""Samples per second of every model against the calibration kernel, and how cost grows."""
from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from bench.measure import quartiles
from bench.workloads import integrand
from montecarlo_brdf.compile import compiler
from montecarlo_brdf.compile.layout import pack
from montecarlo_brdf.estimate import moments, quantity
from montecarlo_brdf.estimate.estimators import directional_albedo
from montecarlo_brdf.estimate.evaluate import Call, Job
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.loading import load
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import NONE, SHAPES
from montecarlo_brdf.vectors import from_degrees

N = 1 << 18  # so many that what a call costs beside its samples does not show
MODELS = ("lambert", "oren_nayar", "eon", "phong", "blinn_phong", "ggx", "beckmann")


def calibration(n: int) -> float:
    """4 square roots and 1 division per sample: what a GGX sample needs at least."""
    total = 0.0
    for i in range(n):
        x = 1.0 + i
        a, b = math.sqrt(x), math.sqrt(x + 2.0)
        c, d = math.sqrt(x + 3.0), math.sqrt(x + 5.0)
        total += (a + b) / (c + d)
    return total


def cosine_job(name: str, samples: int, points: str = "independent") -> Callable[[], Any]:
    """A call that takes `samples` cosine samples of a model with its default parameters."""
    model = load(name)
    p = model.parameters()
    layout, numbers = pack([model.prepared(p)], moments.QUERY)
    mean = quantity.integrand(Quantity.ALBEDO, Sampler.COSINE, {"F": model.f})
    entry = moments.kernel_of(name, points, [mean], layout)
    reals = (*from_degrees(60.0), 0.0, *numbers)
    shape = SHAPES[points](samples) if points in SHAPES else NONE
    job = Job(entry, reals, 1, 1, 1, samples, shape)
    return lambda: job.states(Call(0, 1, 0, samples))


def rates(rounds: int) -> list[dict[str, Any]]:
    """ns per sample per model, and as a fraction of the calibration kernel's speed."""
    limit = compiler.compiled(calibration)
    naive = integrand("W3").loop
    jobs: dict[str, Callable[[], Any]] = {"calibration: 4 sqrt + 1 div": lambda: limit(N)}
    jobs |= {name: cosine_job(name, N) for name in MODELS}
    jobs["ggx at a lattice's points, which take no hash"] = cosine_job("ggx", N, "lattice")
    jobs["naive numba loop, ggx"] = lambda: naive(N)
    seconds: dict[str, list[float]] = {name: [] for name in jobs}
    for k in range(rounds + 1):
        for name, job in jobs.items():
            started = time.process_time()
            job()
            if k:  # the first round compiles
                seconds[name].append(time.process_time() - started)
    base = seconds["calibration: 4 sqrt + 1 div"]
    return [
        {
            "what": name,
            "ns_per_sample": [1e9 * s / N for s in quartiles(times)],
            "ratio_to_calibration": quartiles([a / b for a, b in zip(times, base, strict=True)]),
        }
        for name, times in seconds.items()
    ]


def growth(rounds: int) -> dict[str, list[tuple[int, float]]]:
    """Wall seconds against samples, angles, parameter sets and threads: (count, lowest seconds)."""
    model = load("ggx")
    sets = [model.parameters(alpha=0.1 + 0.01 * k) for k in range(64)]
    angles = [k * 1.4 for k in range(64)]
    albedo = directional_albedo

    def lowest(call: Callable[[], Any]) -> float:
        times = []
        for _ in range(rounds + 1):
            started = time.perf_counter()
            call()
            times.append(time.perf_counter() - started)
        return min(times[1:])

    counts = (1, 4, 16, 64)
    return {
        "samples": [
            (n, lowest(lambda n=n: albedo(model, sets[0], 60.0, samples=n)))  # type: ignore[misc]
            for n in (1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20)
        ],
        "angles": [
            (n, lowest(lambda n=n: albedo(model, sets[0], angles[:n], target_error=1e-6)))  # type: ignore[misc]
            for n in counts
        ],
        "parameters": [
            (n, lowest(lambda n=n: albedo(model, sets[:n], 60.0, target_error=1e-6)))  # type: ignore[misc]
            for n in counts
        ],
        "threads": [
            (n, lowest(lambda n=n: albedo(model, sets[0], 60.0, samples=1 << 22, threads=n)))  # type: ignore[misc]
            for n in (1, 2)
        ],
        "threads, short job": [
            (n, lowest(lambda n=n: albedo(model, sets[0], 60.0, samples=1 << 14, threads=n)))  # type: ignore[misc]
            for n in (1, 2)
        ],
    }
