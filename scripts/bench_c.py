"""What a BRDF in C costs beside the same in Python, as ratios of times measured alternately.

Run: python scripts/bench_c.py, with `cc` and with clang or the package's extra `native`; the exit
code is 1 if a bound is missed. Processor time, the smallest of several.
"""
from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import montecarlo_brdf as mb

FOLDER = Path(__file__).parents[1] / "tests" / "foreign" / "c"
PYTHON = """
import math
from typing import NamedTuple

class Params(NamedTuple):
    alpha: float = 0.3

domain = {"alpha": (0.01, 1.0)}

def masked(w, a):
    return (math.sqrt(w[2] * w[2] + a * a * (w[0] * w[0] + w[1] * w[1])) / w[2] - 1.0) / 2.0

def f(wo, wi, p):
    a, x, y, z = p.alpha, wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    k = 1.0 / math.sqrt(x * x + y * y + z * z)
    x, y, z = k * x, k * y, k * z
    shadowed = 1.0 / (1.0 + masked(wo, a) + masked(wi, a))
    d = (x * x + y * y) / (a * a) + z * z
    return shadowed / (math.pi * a * a * d * d) / (4.0 * wo[2] * wi[2])
"""
SAMPLES, ROUNDS = 1 << 21, 7
#: ratio to Python -> what it may be
BOUNDS = {"inlined": 1.3, "by address": 3.0}


def seconds(model: mb.Model) -> float:
    """Processor time of A by cosine sampling."""
    begun = time.process_time()
    mb.directional_albedo(model, model.parameters(), 60.0, sampler="cosine", samples=SAMPLES)
    return time.process_time() - begun


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        python, library = Path(folder) / "ggx.py", Path(folder) / "lib.so"
        python.write_text(PYTHON, encoding="utf-8")
        command = ["cc", "-O3", "-shared", "-fPIC", "-o", library, FOLDER / "library.c", "-lm"]
        subprocess.run(command, check=True)
        models = [mb.load(str(python)), mb.load(str(FOLDER / "ggx.c")), mb.load(f"{library}:brdf")]
        rows = [[seconds(model) for model in models] for _ in range(ROUNDS + 1)][1:]
    first, *others = (min(column) for column in zip(*rows, strict=True))
    found = {name: other / first for name, other in zip(BOUNDS, others, strict=True)}
    for name, value in found.items():
        print(f"{name}: {value:.2f} (at most {BOUNDS[name]})")
    return int(any(found[name] > bound for name, bound in BOUNDS.items()))


if __name__ == "__main__":
    sys.exit(main())
