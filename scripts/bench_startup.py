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

#: what a tool like this can not do without: numba, click and one call of a cached kernel
BARE = """
import click, numba, numpy
@numba.njit(cache=True)
def kernel(x):
    s = 0.0
    for v in x:
        s += v * v
    return s
kernel(numpy.ones(1000))
"""

#: the albedo of GGX alpha 0.3 at 60 degrees to 1e-6 as a script of one's own would find it
DBLQUAD = """
from math import cos, pi, sin, sqrt
from scipy.integrate import dblquad
alpha, theta_o = 0.3, pi / 3

def smith(mu):
    return (sqrt(1.0 + alpha**2 * (1.0 - mu * mu) / (mu * mu)) - 1.0) / 2.0

def integrand(theta, phi):
    wi, wo = (sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)), (sin(theta_o), 0.0, 0.5)
    x, y, z = (a + b for a, b in zip(wi, wo))
    nh2 = z * z / (x * x + y * y + z * z)
    d = alpha**2 / (pi * (nh2 * (alpha**2 - 1.0) + 1.0) ** 2)
    return d * sin(theta) / (4.0 * wo[2] * (1.0 + smith(wi[2]) + smith(wo[2])))

albedo = 2.0 * dblquad(integrand, 0.0, pi, 0.0, pi / 2.0, epsabs=0.0, epsrel=1e-6)[0]
assert abs(albedo - 0.8217109961) < 1e-6
print(albedo)
"""

COMMAND = [sys.executable, "-m", "montecarlo_brdf"]
FURNACE = [*COMMAND, "furnace", "--model", "lambert"]
TO_MILLIONTH = [*COMMAND, "furnace", "--model", "ggx", "--target-error", "1e-6", "-p"]
GGX = [*TO_MILLIONTH, "alpha=0.3"]
#: a tolerance that no number of samples can decide, so that all of them are used
EXHAUSTIVE = [*FURNACE, "--points", "independent", "--sampler", "uniform", "--tolerance", "1e-9",
              "--theta-o", "60", "--samples"]  # fmt: skip


class Bound(NamedTuple):
    """The median ratio of two cases must not exceed a limit, or (None) is only recorded."""

    label: str
    case: str
    base: str
    limit: float | None


BOUNDS = [
    Bound("--help / import numba", "help", "numba", 0.4),
    Bound("furnace, warm cache / bare script", "warm", "bare", 1.25),
    Bound("furnace, empty cache / import numba", "first", "numba", 6.0),
    Bound("GGX to 1e-6 at 7 angles, asked again / import numba", "GGX", "numba", 0.6),
    Bound("GGX to 1e-6, alpha never asked / import numba", "new GGX", "numba", None),
    Bound("GGX to 1e-6 at 60 degrees, warm / dblquad", "GGX at 60", "dblquad", 1.0),
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
    (folder / "dblquad.py").write_text(DBLQUAD, encoding="utf-8")
    commands = {
        "numba": [sys.executable, "-c", "import numba"],
        "help": [*COMMAND, "--help"],
        "bare": [sys.executable, str(folder / "bare.py")],
        "warm": FURNACE,
        "GGX": GGX,
        "GGX at 60": [*GGX, "--theta-o", "60"],
        "dblquad": [sys.executable, str(folder / "dblquad.py")],
        "first": FURNACE,
    }
    warm = folder / "warm"
    for command in commands.values():
        call(command, warm)
    times: dict[str, list[float]] = {name: [] for name in (*commands, "new GGX")}
    for i in range(ROUNDS):
        for name, command in commands.items():
            if name == "first" and i >= FIRST_ROUNDS:
                continue
            times[name].append(call(command, folder / f"first{i}" if name == "first" else warm))
        times["new GGX"].append(call([*TO_MILLIONTH, f"alpha={0.301 + i / 1000:.3f}"], warm))
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
        holds = bound.limit is None or ratio <= bound.limit
        found[bound.label] = {"ratio": ratio, "bound": bound.limit, "holds": holds}
    found["peak memory, 2^30 / 2^20 samples"] = {
        "ratio": peak["ratio"], "bound": 1.05, "holds": abs(peak["ratio"] - 1.0) <= 0.05
    }  # fmt: skip
    for label, row in found.items():
        state = "ok" if row["holds"] else "MISSED"
        asked = "" if row["bound"] is None else f"(at most {row['bound']:.2f}: {state})"
        print(f"{label:52} {row['ratio']:6.3f} {asked}")
    medians = {name: statistics.median(row) for name, row in times.items()}
    print({name: round(value, 3) for name, value in medians.items()}, peak)
    if record:
        report = {**describe(), "ratios": found, "median seconds": medians, "peak MiB": peak}
        Path(record).write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    return 0 if all(row["holds"] for row in found.values()) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:2] or [None]))
