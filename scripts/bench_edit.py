"""What an edit costs: processor time of commands on a user's file, over that of `import numba`.

A user changes a line of f and runs again; a CI runs once on an empty machine. Cases are taken in
turns, each in a process of its own; a ratio is that of medians. "New file" is a model that was
never compiled where another one was; "edit" changes a factor in f.

    python scripts/bench_edit.py [FILE] [--rounds N] [--tree FOLDER]

FILE: a record in JSON.
"""
from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from environment import describe

ROOT = Path(__file__).parents[1]

#: height-correlated Smith masking, Schlick's Fresnel, drawn by normals
GGX = '''
import math
from typing import NamedTuple

class Params(NamedTuple):
    alpha: float = 0.3
    f0: float = 0.8

domain = {"alpha": (0.05, 1.0), "f0": (0.0, 1.0)}
verified = [Params(), Params(alpha=0.6, f0=0.2)]

def ndf(z, alpha):
    t = z * z * (alpha * alpha - 1.0) + 1.0
    return alpha * alpha / (math.pi * t * t)

def smith(z, alpha):
    return 0.5 * (math.sqrt(1.0 + alpha * alpha * (1.0 - z * z) / (z * z)) - 1.0)

def half(wo, wi):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    s = 1.0 / math.sqrt(x * x + y * y + z * z)
    return x * s, y * s, z * s

def f(wo, wi, p):
    h = half(wo, wi)
    c = wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]
    fresnel = p.f0 + (1.0 - p.f0) * (1.0 - c) ** 5
    g = 1.0 / (1.0 + smith(wo[2], p.alpha) + smith(wi[2], p.alpha))
    return FACTOR * ndf(h[2], p.alpha) * g * fresnel / (4.0 * wo[2] * wi[2])

def sample(wo, u, p):
    phi = 2.0 * math.pi * u[1]
    z = math.sqrt((1.0 - u[0]) / (1.0 + (p.alpha * p.alpha - 1.0) * u[0]))
    r = math.sqrt(max(0.0, 1.0 - z * z))
    x, y = r * math.cos(phi), r * math.sin(phi)
    c = wo[0] * x + wo[1] * y + wo[2] * z
    return 2.0 * c * x - wo[0], 2.0 * c * y - wo[1], 2.0 * c * z - wo[2]

def pdf(wo, wi, p):
    h = half(wo, wi)
    c = wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]
    return ndf(h[2], p.alpha) * h[2] / (4.0 * c)
'''

#: what was compiled before the new file: one parameter, cosine-weighted draws
OTHER = '''
import math
from typing import NamedTuple

class Params(NamedTuple):
    k: float = 0.4

domain = {"k": (0.1, 0.9)}

def f(wo, wi, p):
    return p.k * (1.0 + 0.5 * wo[2] * wi[2]) / (1.5 * math.pi)

def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])

def pdf(wo, wi, p):
    return wi[2] / math.pi
'''

IMPORT = "import numba"
LAMBERT = "first furnace of lambert"


class Bench:
    """Caches and files in a folder, and what commands cost with them."""

    def __init__(self, folder: Path, tree: Path) -> None:
        self.folder, self.tree = folder, tree
        self.edits = 0
        self.file, self.other = folder / "mine.py", folder / "other.py"
        self.other.write_text(OTHER, encoding="utf-8")
        self.edit()

    def edit(self) -> None:
        """Another factor in f; the verdict stays."""
        self.edits += 1
        self.file.write_text(GGX.replace("FACTOR", f"0.99{self.edits}"), encoding="utf-8")

    def cost(self, cache: str, *command: str) -> float:
        """User and system seconds of a process, of all its threads."""
        environment = {k: v for k, v in os.environ.items() if not k.startswith("BRDF_CHECK_")}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        environment["BRDF_CHECK_CACHE_DIR"] = str(self.folder / cache)
        environment["PYTHONPATH"] = str(self.tree)
        with open(os.devnull, "w", encoding="utf-8") as void:
            child = subprocess.Popen([sys.executable, *command], env=environment, stdout=void,
                                     stderr=void)  # fmt: skip
            _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode not in (0, 1, 3):
            raise SystemExit(f"{' '.join(command)} ended with {child.returncode}")
        return used.ru_utime + used.ru_stime

    def ask(self, cache: str, question: str, model: object) -> float:
        """The cost of brdf-check."""
        return self.cost(cache, "-m", "montecarlo_brdf", question, "--model", str(model))

    def copy(self, source: str, target: str) -> None:
        """A cache as it was left."""
        shutil.rmtree(self.folder / target, ignore_errors=True)
        shutil.copytree(self.folder / source, self.folder / target)

    def clear(self, cache: str) -> None:
        """A new machine."""
        shutil.rmtree(self.folder / cache, ignore_errors=True)

    def round(self) -> dict[str, float]:
        """Every case once."""
        self.clear("run"), self.clear("lambert"), self.copy("parts", "new")
        self.copy("parts", "furnace")
        found = {IMPORT: self.cost("none", "-c", IMPORT)}
        found["first run on the machine"] = self.ask("run", "run", self.file)
        found["run of a new file"] = self.ask("new", "run", self.file)
        found["warm run"] = self.ask("new", "run", self.file)
        self.edit()
        found["run after an edit of f"] = self.ask("new", "run", self.file)
        found["furnace of a new file"] = self.ask("furnace", "furnace", self.file)
        found["warm furnace"] = self.ask("furnace", "furnace", self.file)
        self.edit()
        found["furnace after an edit of f"] = self.ask("furnace", "furnace", self.file)
        found[LAMBERT] = self.ask("lambert", "furnace", "lambert")
        found["warm furnace of lambert"] = self.ask("lambert", "furnace", "lambert")
        return found


def measured(tree: Path, rounds: int) -> dict[str, list[float]]:
    """Seconds of every case, round by round."""
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(Path(name), tree)
        for question in ("run", "furnace"):
            bench.ask("parts", question, bench.other)
        times: dict[str, list[float]] = {}
        for _ in range(rounds):
            for case, seconds in bench.round().items():
                times.setdefault(case, []).append(seconds)
    return times


def main() -> None:
    """Measure, print, record."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("record", type=Path, nargs="?")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--tree", type=Path, default=ROOT)
    options = parser.parse_args()
    times = measured(options.tree.resolve(), options.rounds)
    medians = {case: statistics.median(row) for case, row in times.items()}
    ratios = {case: value / medians[IMPORT] for case, value in medians.items()}
    for case, value in medians.items():
        print(f"{case:28} {value:6.2f} s  {ratios[case]:5.1f} x import numba")
    if options.record:
        found = {**describe(), "processor seconds": medians, "over import numba": ratios}
        options.record.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
