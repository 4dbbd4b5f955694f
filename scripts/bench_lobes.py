"""Time to a relative error of 1e-6: Beckmann's lobes beside those of GGX, asked in turn.

Ratios are of processor times through the public API, median and quartiles over rounds with a seed
each; beside them the samples that a replicate took, and nanoseconds per sample of both kernels at
the same points of a lattice in the fitted chart.

    python scripts/bench_lobes.py [ROUNDS]
"""
from __future__ import annotations

import json
import os
import statistics
import sys
import time
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf.estimate import adaptive, evaluate
from montecarlo_brdf.sampling.points import SHAPES
from montecarlo_brdf.vectors import from_degrees

TARGET = Path(__file__).parent / "results" / "bench_lobes.json"
MODELS = {name: mb.load(name) for name in ("ggx", "beckmann")}
CASES = ((0.3, 60.0), (0.05, 80.0), (0.01, 85.0), (0.001, 89.0))
SIZE, REPLICATES = 1024, 128


def asked(name: str, alpha: float, theta: float, seed: int) -> tuple[float, int]:
    """Processor seconds and samples of one estimate."""
    model = MODELS[name]
    p = model.parameters(alpha=alpha)
    began = time.process_time()
    e = mb.directional_albedo(model, p, theta, target_error=1e-6, seed=seed)
    return time.process_time() - began, e.samples


def per_sample(name: str) -> float:
    """Nanoseconds in the chart, at many samples."""
    model = MODELS[name]
    p = model.parameters()
    made = adaptive.prepare(model, p, type(p), adaptive.methods(model)[0])
    reals = (*from_degrees(60.0), made.width, *made.numbers)
    entry = made.means()
    shape = SHAPES["lattice"](SIZE)
    began = time.perf_counter()
    evaluate.run(evaluate.Job(entry, reals, 1, SIZE, REPLICATES, SIZE, shape))
    return (time.perf_counter() - began) / (SIZE * REPLICATES) * 1e9


def compared(a: list[float], b: list[float]) -> dict[str, Any]:
    """b/a, in turn."""
    low, middle, high = statistics.quantiles((y / x for x, y in zip(a, b, strict=True)), n=4)
    return {"ratio": middle, "quartiles": [low, high]}


def case(alpha: float, theta: float, rounds: int) -> dict[str, Any]:
    """One row."""
    found = [[asked(name, alpha, theta, seed) for name in MODELS] for seed in range(rounds + 3)]
    times = [[row[k][0] for row in found[3:]] for k in range(len(MODELS))]  # the first ones warm up
    return {
        "alpha": alpha,
        "theta_o": theta,
        "microseconds": {n: 1e6 * statistics.median(t) for n, t in zip(MODELS, times, strict=True)},
        "samples": {n: found[-1][k][1] for k, n in enumerate(MODELS)},
        **compared(*times),
    }


def main() -> None:
    """Print and record."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 61
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    rows = [case(alpha, theta, rounds) for alpha, theta in CASES]
    pairs = [[per_sample(name) for name in MODELS] for _ in range(rounds)]
    chart = [list(times) for times in zip(*pairs, strict=True)]
    fastest = {n: min(t) for n, t in zip(MODELS, chart, strict=True)}
    result = {**describe(), "cases": rows, "ns per sample": {**fastest, **compared(*chart)}}
    for row in (*rows, result["ns per sample"]):
        print(row)
    TARGET.write_text(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
