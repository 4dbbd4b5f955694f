"""Run the benchmark on one core and record it in scripts/results, a workload at a time.

    pip install 'montecarlo-brdf[bench]'
    python scripts/benchmark.py [ROUNDS] [W3,W4,rates]

All methods of a workload are timed in turn within one run; what is named replaces what was
recorded, so that a shared machine need not be quiet for as long as everything takes.
"""
from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

from montecarlo_brdf.bench import measure, throughput
from montecarlo_brdf.bench.workloads import WORKLOADS
from montecarlo_brdf.judge.finding import versions
from montecarlo_brdf.report.bench_markdown import markdown
from montecarlo_brdf.report.bench_plots import bench_figure
from montecarlo_brdf.report.pictures import encoded

RESULTS = Path(__file__).parent / "results"
RATES = "rates"  # samples per second and growth of cost


def main() -> None:
    """Measure and record after each workload."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 11
    everything = [RATES, *(w.name for w in WORKLOADS)]
    chosen = sys.argv[2].split(",") if len(sys.argv) > 2 else everything
    chosen.sort(key=lambda name: name != RATES)  # first, as long as no core is chosen
    recorded = RESULTS / "bench.json"
    data: dict[str, Any] = json.loads(recorded.read_text()) if recorded.exists() else {}
    data |= {"schema": 1, "command": "bench", "machine": throughput.processor(), "rounds": rounds}
    data["versions"] = ", ".join(f"{k} {v}" for k, v in versions().items())
    for name in chosen:
        if name == RATES:
            data["growth"] = throughput.growth(rounds)  # before pinning: it measures threads
            pinned()
            data["rates"] = throughput.rates(rounds)
        else:
            pinned()
            (found,) = measure.bench(list(measure.METHODS), [name], rounds)
            others = [r for r in data.get("results", []) if r["workload"] != name]
            data["results"] = sorted([*others, found], key=lambda r: r["workload"])
        recorded.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
        print(name, "recorded", flush=True)
    (RESULTS / "bench.md").write_text(markdown(data), encoding="utf-8")
    (RESULTS / "bench.png").write_bytes(encoded(bench_figure(data), "png"))


def pinned() -> None:
    """On one core from now on."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


if __name__ == "__main__":
    main()
