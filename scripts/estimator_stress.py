"""What hostile integrands, counters and seeds do to the estimators, with figures.

    python scripts/estimator_stress.py

Writes scripts/results/estimator_stress.json. Sums of 2^40 samples are composed from states of
calls, which is what a kernel returns, and held against exact rational sums; points are drawn around
the boundaries of their counters and put to the same tests as at 0; verdicts are those of `furnace`.
"""

from __future__ import annotations

import json
import math
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from scipy import stats

import montecarlo_brdf as mb
from montecarlo_brdf.bits import u64
from montecarlo_brdf.estimate import evaluate
from montecarlo_brdf.files import write_text
from montecarlo_brdf.sampling import points
from montecarlo_brdf.statistics import Moments

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "stability"))
POINTS = 1 << 14


def accumulation() -> dict[str, float]:
    """Relative errors of means of 2^40 samples."""
    from test_estimators import block, exact_mean, total

    equal = Moments(float(evaluate.CHUNK), 0.1, 0.0, 0.1)
    for _ in range(40 - 17):
        equal = total([equal, equal])
    smooth = 1.0 + np.sin(np.linspace(0.0, 3.0, evaluate.CHUNK))
    means = 0.7 + 0.01 * np.random.default_rng(3).standard_normal(4096)
    merged = total([Moments(2.0**28, float(m), 1.0, 1.0) for m in means])
    return {
        "samples": merged.count,
        "equal": abs(equal.mean - 0.1) / 0.1,
        "smooth, within a call of 2^17": _relative(block(smooth).mean, exact_mean(smooth)),
        "smooth, 4096 calls' states of 2^28 each": _relative(merged.mean, exact_mean(means)),
    }


def hostile() -> dict[str, float]:
    """Errors relative to the mean of |x| of 2^14 values."""
    from test_estimators import block, exact_mean

    many = np.arange(1 << 14)
    ranging = 10.0 ** np.random.default_rng(5).uniform(-100.0, 0.0, len(many))
    found = {}
    for name, x in {
        "constant 1/3": np.full(len(many), 1.0 / 3.0),
        "constant 5e-324": np.full(len(many), 5e-324),
        "alternating": np.where(many % 2, 1.0, -1.0 + 1e-9),
        "alternating, times 1e150": 1e150 * np.where(many % 2, 1.0, -1.0 + 1e-9),
        "range of 1e100": ranging,
        "range of 1e100, times 1e150": 1e150 * ranging,
    }.items():
        size = sum(map(Fraction, np.abs(x).tolist())) / len(x)
        found[name] = float(abs(Fraction(block(x).mean) - exact_mean(x)) / size)
    return found


def _relative(value: float, exact: Fraction) -> float:
    return float(abs(Fraction(value) - exact) / abs(exact))


def counters() -> dict[str, dict[str, float]]:
    """p-values of tests of independent points from indices around each boundary."""
    key = points.replicate_key(u64(99), 0)
    starts = {"0": 0, "2^31": 1 << 31, "2^32": 1 << 32, "2^53": 1 << 53, "2^63": 1 << 63}
    found = {}
    for name, middle in starts.items():
        first = max(0, middle - POINTS // 2)
        rows = [points.independent(key, u64(first + i))[:3] for i in range(POINTS)]
        found[name] = tested(np.array(rows))
    last = (1 << 64) - POINTS
    rows = [points.independent(key, u64(last + i))[:3] for i in range(POINTS)]
    return {**found, "up to 2^64 - 1": tested(np.array(rows))}


def tested(x: Any) -> dict[str, float]:
    """p-values: uniform, in 8^3 cells, without correlation to the next point."""
    cells = (x * 8.0).astype(int) @ (64, 8, 1)
    lag = np.corrcoef(x[:-1, 0], x[1:, 0])[0, 1] * math.sqrt(len(x) - 1)
    return {
        "uniform": float(stats.kstest(x[:, 0], "uniform").pvalue),
        "cells": float(stats.chisquare(np.bincount(cells, minlength=512)).pvalue),
        "lag": float(2.0 * stats.norm.sf(abs(lag))),
        "repeated": float(len(x) - len(np.unique(x[:, 0]))),
    }


def seeds() -> dict[str, float]:
    """Deviation from the truth in standard errors, for seeds at the limits of types."""
    model = mb.load("lommel_seeliger")
    mu = math.sqrt(0.5)
    truth = 0.8 * (1.0 - mu * math.log1p(1.0 / mu))
    found = {}
    for seed in (0, (1 << 31) - 1, 1 << 31, (1 << 32) - 1, 1 << 32, (1 << 63) - 1, 1 << 63,
                 (1 << 64) - 1):  # fmt: skip
        e = mb.directional_albedo(model, model.parameters(), 45.0, points="independent", seed=seed,
                                  samples=2**14)  # fmt: skip
        found[str(seed)] = (e.mean - truth) / e.stderr
    return found


def verdicts() -> list[dict[str, Any]]:
    """`furnace` of heavy tails and of near-delta lobes under samplers that are wrong for them."""
    cases: list[tuple[str, dict[str, float], str]] = [
        *(("minnaert", {"k": k}, "all") for k in (-0.4, -0.2, 0.0, 0.1, 0.25, 0.5)),
        *(("ggx", {"alpha": a}, "cosine") for a in (1e-4, 1e-3, 1e-2)),
        *(("ggx", {"alpha": a}, "uniform") for a in (1e-4, 1e-3)),
        *(("phong", {"n": n}, "cosine") for n in (1e4, 1e6)),
        *(("phong", {"n": n}, "all") for n in (1e4, 1e6)),
    ]
    return [_verdict(*case) for case in cases]


def _verdict(name: str, values: dict[str, float], sampler: str) -> dict[str, Any]:
    model = mb.load(name)
    p = model.parameters(**values)
    report = mb.furnace(model, p, [30.0], sampler=sampler, samples=2**18, threads=1)
    finding = next(f for f in report.results[0].findings if f.quantity == "A")
    unused = {e["estimator"]: e["not_used"] for e in finding.estimators if "not_used" in e}
    return {"model": name, **values, "sampler": sampler, "verdict": finding.verdict,
            "value": finding.value, "expected": finding.expected, "by": finding.estimator,
            "not used": unused}  # fmt: skip


def few() -> list[dict[str, Any]]:
    """Hardly any samples or replicates."""
    model = mb.load("ggx")
    rows = []
    for samples, replicates in ((1, 16), (1, 1), (2, 1), (17, 16), (1 << 14, 1)):
        e = mb.directional_albedo(model, model.parameters(), 45.0, samples=samples,
                                  replicates=replicates)  # fmt: skip
        rows.append({"samples": samples, "replicates": replicates, "shown": str(e)})
    return rows


def main() -> None:
    parts = (accumulation, hostile, counters, seeds, few, verdicts)
    found = {part.__name__: part() for part in parts}
    path = ROOT / "scripts" / "results" / "estimator_stress.json"
    write_text(path, json.dumps(found, indent=1) + "\n")
    print(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
