"""Mitsuba's own chi-square test at its defaults, for comparison: time, and what it sees.

Rough conductor (GGX, alpha 0.3, visible normals) at 45 degrees. Honest; with a pdf 1 % too large;
with a sampler whose alpha is 2 % off. Needs `pip install mitsuba` and a libLLVM.

    python scripts/mitsuba_chi2.py [--runs 100]
"""
from __future__ import annotations

import argparse
import json
import math
import os
import statistics
import tempfile
import time
from pathlib import Path
from typing import Any

import mitsuba as mi
from environment import describe

mi.set_variant("llvm_ad_rgb")
from mitsuba.chi2 import BSDFAdapter, ChiSquareTest, SphericalDomain  # noqa: E402

TARGET = Path(__file__).resolve().parent / "results" / "mitsuba_chi2.json"
WI = [math.sin(math.pi / 4), 0.0, math.cos(math.pi / 4)]
CONDUCTOR = '<string name="distribution" value="ggx"/><float name="alpha" value="{}"/>'


def adapter(alpha: float) -> Any:
    """(sample, pdf) of Mitsuba's rough conductor."""
    return BSDFAdapter("roughconductor", CONDUCTOR.format(alpha), wi=WI)


def large(function: Any) -> Any:
    """The density, 1 % too large everywhere."""
    return lambda *args: 1.01 * function(*args)


def subjects() -> dict[str, tuple[Any, Any]]:
    """name -> sample and pdf."""
    sample, pdf = adapter(0.3)
    return {
        "honest": (sample, pdf),
        "pdf 1 % too large": (sample, large(pdf)),
        "warp 2 % off": (adapter(0.306)[0], pdf),
    }


def measured(sample: Any, pdf: Any, runs: int) -> dict[str, Any]:
    """How often it is rejected at the default level, and the time of a test."""
    times, rejected = [], 0
    for seed in range(runs + 2):
        began = time.perf_counter()
        test = ChiSquareTest(SphericalDomain(), sample, pdf, sample_dim=3, seed=seed)
        accepted = test.run()
        times.append(time.perf_counter() - began)
        rejected += seed >= 2 and not accepted
    return {
        "runs": runs,
        "rejected": rejected,
        "milliseconds, median": 1e3 * statistics.median(times[2:]),
        "milliseconds, least": 1e3 * min(times[2:]),
    }


def main() -> None:
    """Measure and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=100)
    runs = parser.parse_args().runs
    os.chdir(tempfile.mkdtemp())  # where rejected tests leave their data
    table = {}
    for name, (sample, pdf) in subjects().items():
        table[name] = measured(sample, pdf, runs)
        print(name, table[name], flush=True)
    where = describe()
    where["versions"]["mitsuba"] = mi.__version__
    TARGET.write_text(json.dumps({**where, "subjects": table}, indent=1))


if __name__ == "__main__":
    main()
