"""How long whole processes take, as ratios of times measured alternately, and how much memory.

Run: python scripts/bench_startup.py [FILE], with FILE for a record in JSON; the exit code is 1 if a
bound is missed.
"""
from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, NamedTuple

from environment import describe

ROUNDS = 15
FIRST_ROUNDS = 5

#: what a tool like this can not do without: numba, click, rich and one call of a cached kernel
BARE = """
import click, rich, rich.console, numba, numpy
@numba.njit(cache=True)
def kernel(x):
    s = 0.0
    for v in x:
        s += v * v
    return s
kernel(numpy.ones(1000))
"""

COMMAND = [sys.executable, "-m", "montecarlo_brdf"]
FURNACE = [*COMMAND, "furnace", "--model", "lambert"]
#: a tolerance that no number of samples can decide, so that all of them are used
EXHAUSTIVE = [*FURNACE, "--points", "independent", "--sampler", "uniform", "--tolerance", "1e-9",
              "--theta-o", "60", "--samples"]  # fmt: skip


class Bound(NamedTuple):
    """The median ratio of two cases must not exceed a limit."""

    label: str
    case: str
    base: str
    limit: float


BOUNDS = [
    Bound("--help / import numba", "help", "numba", 0.4),
    Bound("furnace, warm cache / bare script", "warm", "bare", 1.25),
    Bound("furnace, empty cache / import numba", "first", "numba", 6.0),
]


def call(command: list[str], cache: Path) -> float:
    """Seconds that a process takes."""
    environment = {**os.environ, "BRDF_CHECK_CACHE_DIR": str(cache), "NUMBA_CACHE_DIR": str(cache)}
    started = time.perf_counter()
    done = subprocess.run(command, env=environment, stdout=subprocess.DEVNULL)
    seconds = time.perf_counter() - started
    if done.returncode not in (0, 3):
        raise SystemExit(f"{' '.join(command)} ended with {done.returncode}")
    return seconds


def peak_memory(command: list[str], cache: Path) -> float:
    """Largest resident set of a process in MiB."""
    watch = (
        "import resource, subprocess, sys; subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL);"
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
    )
    environment = {**os.environ, "BRDF_CHECK_CACHE_DIR": str(cache)}
    out = subprocess.check_output([sys.executable, "-c", watch, *command], env=environment)
    return int(out) / (1024.0**2 if sys.platform == "darwin" else 1024.0)


def measure(folder: Path) -> dict[str, list[float]]:
    """Times of all cases, taken in turns."""
    (folder / "bare.py").write_text(BARE, encoding="utf-8")
    commands = {
        "numba": [sys.executable, "-c", "import numba"],
        "help": [*COMMAND, "--help"],
        "bare": [sys.executable, str(folder / "bare.py")],
        "warm": FURNACE,
        "first": FURNACE,
    }
    warm = folder / "warm"
    for command in commands.values():
        call(command, warm)
    times: dict[str, list[float]] = {name: [] for name in commands}
    for i in range(ROUNDS):
        for name, command in commands.items():
            if name == "first" and i >= FIRST_ROUNDS:
                continue
            times[name].append(call(command, folder / f"first{i}" if name == "first" else warm))
    return times


def memory(folder: Path) -> dict[str, float]:
    """Peak memory for few and many samples."""
    call([*EXHAUSTIVE, "2^16"], folder / "warm")  # compiling takes memory of its own
    few, many = (peak_memory([*EXHAUSTIVE, n], folder / "warm") for n in ("2^20", "2^30"))
    return {"2^20 samples": few, "2^30 samples": many, "ratio": many / few}


def main(record: str | None) -> int:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        times, peak = measure(folder), memory(folder)
    found: dict[str, Any] = {}
    for bound in BOUNDS:
        pairs = zip(times[bound.case], times[bound.base], strict=False)
        ratio = statistics.median(a / b for a, b in pairs)
        found[bound.label] = {"ratio": ratio, "bound": bound.limit, "holds": ratio <= bound.limit}
    found["peak memory, 2^30 / 2^20 samples"] = {
        "ratio": peak["ratio"], "bound": 1.05, "holds": abs(peak["ratio"] - 1.0) <= 0.05
    }  # fmt: skip
    for label, row in found.items():
        state = "ok" if row["holds"] else "MISSED"
        print(f"{label:40} {row['bound']:5.2f}: {row['ratio']:5.3f} {state}")
    medians = {name: statistics.median(row) for name, row in times.items()}
    print({name: round(value, 3) for name, value in medians.items()}, peak)
    if record:
        report = {**describe(), "ratios": found, "median seconds": medians, "peak MiB": peak}
        Path(record).write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    return 0 if all(row["holds"] for row in found.values()) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:2] or [None]))
