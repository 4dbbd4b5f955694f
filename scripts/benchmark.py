"""Run the benchmark beside our peers on one core and record it, a workload at a time.

    pip install -r scripts/bench/requirements.txt
    python scripts/benchmark.py [ROUNDS] [W3,W4,rates]

Timings go to scripts/results/bench.json, tables to bench.md beside it, the picture to docs/figures.
All methods of a workload are timed in turn within one run; what is named replaces what was
recorded, so that a shared machine need not be quiet for as long as everything takes.
"""
from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

from bench import measure, throughput
from bench.picture import bench_figure
from bench.tables import markdown
from bench.workloads import WORKLOADS
from environment import processor

from montecarlo_brdf.judge.finding import versions
from montecarlo_brdf.report.plots import save

RESULTS = Path(__file__).parent / "results"
PICTURE = RESULTS.parents[1] / "docs" / "figures" / "time_against_error.png"
RATES = "rates"  # samples per second and growth of cost


def main() -> None:
    """Measure and record after each workload."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 11
    works = {w.name: w for w in WORKLOADS}
    chosen = sys.argv[2].split(",") if len(sys.argv) > 2 else [RATES, *works]
    if strange := {*chosen} - {RATES, *works}:
        sys.exit(f"no workload {', '.join(strange)} (choose from {', '.join((RATES, *works))})")
    chosen.sort(key=lambda name: name != RATES)  # first, as long as no core is chosen
    recorded = RESULTS / "bench.json"
    data: dict[str, Any] = json.loads(recorded.read_text()) if recorded.exists() else {}
    data |= {"schema": 1, "command": "bench", "machine": processor(), "rounds": rounds}
    data["versions"] = ", ".join(f"{k} {v}" for k, v in versions().items())
    for name in chosen:
        if name == RATES:
            data["growth"] = throughput.growth(rounds)  # before pinning: it measures threads
            pinned()
            data["rates"] = throughput.rates(rounds)
        else:
            pinned()
            found = measure.compare(works[name], list(measure.METHODS), rounds)
            others = [r for r in data.get("results", []) if r["workload"] != name]
            data["results"] = sorted([*others, found], key=lambda r: r["workload"])
        recorded.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
        print(name, "recorded", flush=True)
    (RESULTS / "bench.md").write_text(markdown(data), encoding="utf-8")
    save(bench_figure(data), PICTURE)


def pinned() -> None:
    """On one core from now on."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


if __name__ == "__main__":
    main()
