"""GGX samples per second of a Dr.Jit kernel written by hand, and of Mitsuba's eval, beside ours.

One albedo estimate of GGX (alpha 0.3, 60 degrees) by cosine sampling in double precision on one
core: our kernel; the same arithmetic as one Dr.Jit kernel (LLVM, its own PCG32 numbers, textbook
formulas); and Mitsuba's rough conductor, whose wheel evaluates in single precision and here has no
random numbers to make. Needs `pip install mitsuba` beside this package and a libLLVM.

    python scripts/drjit_rate.py [ROUNDS]
"""
from __future__ import annotations

import json
import math
import os
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import drjit as dr
import mitsuba as mi
from environment import describe

mi.set_variant("llvm_ad_mono")
from bench.throughput import cosine_job  # noqa: E402
from drjit.llvm import PCG32, UInt64  # noqa: E402

TARGET = Path(__file__).parent / "results" / "drjit_rate.json"
N = 1 << 20
ALPHA, THETA = 0.3, math.radians(60.0)
WO = math.sin(THETA), 0.0, math.cos(THETA)


def smith(mu: Any) -> Any:
    """Lambda of GGX."""
    tangent2 = (1.0 - mu * mu) / (mu * mu)
    return 0.5 * (dr.sqrt(1.0 + ALPHA**2 * tangent2) - 1.0)


def ggx(wi: Any) -> Any:
    """D G2/(4 mu_i mu_o), height-correlated, F = 1."""
    hx, hy, hz = wi[0] + WO[0], wi[1] + WO[1], wi[2] + WO[2]
    cos2 = hz * hz / (hx * hx + hy * hy + hz * hz)
    d = ALPHA**2 / (math.pi * dr.square(cos2 * (ALPHA**2 - 1.0) + 1.0))
    return d / (1.0 + smith(wi[2]) + smith(WO[2] + 0.0 * wi[2])) / (4.0 * wi[2] * WO[2])


def by_hand() -> Any:
    """The estimate as one fused Dr.Jit kernel."""
    numbers = PCG32(size=N, initstate=UInt64(7))
    u1, u2 = numbers.next_float64(), numbers.next_float64()
    r = dr.sqrt(u1)
    s, c = dr.sincos(2.0 * math.pi * u2)
    value = dr.sum(ggx((r * c, r * s, dr.sqrt(1.0 - u1)))) * math.pi / N
    dr.eval(value)
    dr.sync_thread()
    return value


def mitsuba_eval() -> Callable[[], Any]:
    """f cos of Mitsuba's rough conductor at directions made before."""
    bsdf = mi.load_dict(
        {"type": "roughconductor", "distribution": "ggx", "alpha": ALPHA, "material": "none"}
    )
    numbers = mi.PCG32(size=N)
    u1, u2 = numbers.next_float32(), numbers.next_float32()
    r = dr.sqrt(u1)
    s, c = dr.sincos(2.0 * math.pi * u2)
    wo = mi.Vector3f(r * c, r * s, dr.sqrt(1.0 - u1))
    si = dr.zeros(mi.SurfaceInteraction3f, N)
    si.wi = mi.Vector3f(*WO)
    dr.eval(wo, si)
    dr.sync_thread()

    def call() -> Any:
        value = dr.sum(bsdf.eval(mi.BSDFContext(), si, wo)[0] / wo.z) * math.pi / N
        dr.eval(value)
        dr.sync_thread()
        return value

    return call


def seconds(calls: dict[str, Callable[[], Any]], rounds: int) -> dict[str, list[float]]:
    """Processor seconds of each call, in turns; the first round compiles."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for k in range(rounds + 1):
        for name, call in calls.items():
            started = time.process_time()
            call()
            if k:
                times[name].append(time.process_time() - started)
    return times


def main() -> None:
    """Measure, print and record."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    dr.set_thread_count(1)
    ours, theirs = cosine_job("ggx", N), mitsuba_eval()
    values = {"ours": ours()[1], "drjit": float(by_hand()[0]), "mitsuba": float(theirs()[0])}
    assert max(values.values()) - min(values.values()) < 0.02, values
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 21
    times = seconds({"ours": ours, "drjit": by_hand, "mitsuba": theirs}, rounds)
    rows = {}
    for name, row in times.items():
        ratios = [a / b for a, b in zip(row, times["ours"], strict=True)]
        rows[name] = {
            "value": values[name],
            "ns per sample": 1e9 * statistics.median(row) / N,
            "times ours, median": statistics.median(ratios),
        }
        print(name, rows[name])
    TARGET.write_text(json.dumps({**describe(), "rounds": rounds, "rows": rows}, indent=1))


if __name__ == "__main__":
    main()
