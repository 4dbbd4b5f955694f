"""Run the whole benchmark on one core and record it in scripts/results.

    pip install 'montecarlo-brdf[bench]'
    python scripts/benchmark.py [ROUNDS]
"""
from __future__ import annotations

import os
import sys
from pathlib import Path

from montecarlo_brdf.cli import execute as run

RESULTS = Path(__file__).parent / "results"


def main() -> int:
    """Pin to one core, then measure."""
    rounds = sys.argv[1] if len(sys.argv) > 1 else "11"
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    RESULTS.mkdir(exist_ok=True)
    files = {"--export-json": "bench.json", "--markdown": "bench.md", "--plot": "bench.png"}
    outputs = [str(part) for k, name in files.items() for part in (k, RESULTS / name)]
    return run(["bench", "--rounds", rounds, "--rates", *outputs])


if __name__ == "__main__":
    sys.exit(main())
