"""How long the truth takes: one (model, angle) of each reference, and a curve of 90 angles.

Times are medians over warm calls, also as multiples of one call of the calibration kernel (2^17
samples of two square roots each), in one run on one core.

    python scripts/bench_references.py [results.json]
"""
from __future__ import annotations

import json
import math
import os
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import numba
from environment import describe

from montecarlo_brdf import references

ANGLES = (0.0, 30.0, 60.0, 85.0, 89.0, 89.9, 89.99)
#: name -> reference, parameters, the most milliseconds that one angle may take
CASES: dict[str, tuple[str, dict[str, Any], float]] = {
    "ggx alpha 0.3": ("ggx", {"alpha": 0.3, "f0": 1.0}, 2.0),
    "ggx alpha 0.05": ("ggx", {"alpha": 0.05, "f0": 1.0}, 2.0),
    "ggx alpha 0.05, f0 0.04": ("ggx", {"alpha": 0.05, "f0": 0.04}, 2.0),
    "ggx alpha 0.001": ("ggx", {"alpha": 0.001, "f0": 1.0}, 20.0),
    "v_cavity alpha 0.001": ("cook_torrance", {"masking": "v_cavity", "alpha": 0.001}, 20.0),
    "beckmann alpha 0.001": ("beckmann", {"alpha": 0.001, "f0": 1.0}, 20.0),
    "beckmann alpha 0.05": ("beckmann", {"alpha": 0.05, "f0": 1.0}, 20.0),
    "phong n 1e6": ("phong", {"ks": 1.0, "n": 1e6}, 20.0),
    "blinn_phong n 1e6": ("blinn_phong", {"ks": 1.0, "n": 1e6, "norm": "n+2"}, 20.0),
    "oren_nayar_full": ("oren_nayar_full", {"albedo": 1.0, "sigma": 0.5}, 20.0),
    "disney_diffuse": ("disney_diffuse", {"albedo": 1.0, "roughness": 0.5}, 20.0),
}
SAMPLES = 1 << 17


@numba.njit(error_model="numpy", fastmath={"reassoc", "contract", "nsz", "arcp", "afn"})
def two_roots(a: float, b: float) -> float:
    """The calibration loop."""
    s = t = 0.0
    for i in range(SAMPLES):
        s += math.sqrt(a + i)
        t += math.sqrt(b + i)
    return s + t


def median_seconds(call: Callable[[], Any], rounds: int = 15) -> float:
    """Median time of warm calls."""
    call()
    times = []
    for _ in range(rounds):
        started = time.perf_counter()
        call()
        times.append(time.perf_counter() - started)
    return statistics.median(times)


def cosine(theta_deg: float) -> float:
    """The cosine with all its digits."""
    return math.sin(math.radians(90.0 - theta_deg))


def main() -> None:
    """Print the table, and write it if a file is named."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    unit = median_seconds(lambda: two_roots(1.0, 2.0))
    rows: dict[str, Any] = {}
    for name, (model, given, bound) in CASES.items():
        each = [
            median_seconds(lambda t=t: references.albedo(model, cosine(t), **given))  # noqa: B023
            for t in ANGLES
        ]
        worst = max(each)
        rows[name] = {
            "median ms": statistics.median(each) * 1e3,
            "worst ms": worst * 1e3,
            "worst, calibration calls": worst / unit,
            "at most ms": bound,
        }
        print(
            f"{name:26} median {statistics.median(each) * 1e3:7.3f} ms, "
            f"worst {worst * 1e3:7.3f} ms "
            f"= {worst / unit:6.1f} calibration calls (at most {bound:g} ms)"
        )
    curve = median_seconds(
        lambda: [references.albedo("ggx", cosine(t), alpha=0.05, f0=1.0) for t in range(90)], 3
    )
    print(f"a curve of 90 angles, ggx alpha 0.05: {curve * 1e3:.0f} ms")
    if sys.argv[1:]:
        result = {**describe(), "references": rows, "curve of 90 angles, ms": curve * 1e3}
        with open(sys.argv[1], "w", encoding="utf-8") as file:
            json.dump(result, file, indent=1)


if __name__ == "__main__":
    main()
