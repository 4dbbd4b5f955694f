"""What a shader costs beside a model file in Python, as ratios of times measured alternately.

Run: python scripts/bench_shaders.py, with the package's extra `shaders` installed; the exit code is
1 if a bound is missed. Processor time, the smallest of several. Python's own cache of modules is
on, as where the package is installed.
"""
from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import montecarlo_brdf as mb
from montecarlo_brdf.foreign import translation

ROOT = Path(__file__).parents[1]
SHADERS = ROOT / "tests" / "foreign" / "shaders"
SHADER, LONG = SHADERS / "ggx_stable.glsl", SHADERS / "layered.glsl"
PYTHON = """
import math
from typing import NamedTuple

class Params(NamedTuple):
    alpha: float = 0.3

domain = {"alpha": (0.001, 1.0)}

def stretched(w, a):
    return math.sqrt(w[2] * w[2] + a * a * (w[0] * w[0] + w[1] * w[1]))

def f(wo, wi, p):
    x, y, z = wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]
    k = 1.0 / math.sqrt(x * x + y * y + z * z)
    x, y, z = k * x, k * y, k * z
    d = p.alpha / (x * x + y * y + p.alpha * p.alpha * z * z)
    masked = wi[2] * stretched(wo, p.alpha) + wo[2] * stretched(wi, p.alpha)
    return d * d * 0.5 / (math.pi * masked)
"""
SAMPLES, ROUNDS = 1 << 22, 7
FURNACE = ("furnace", "--theta-o", "0,60", "--sampler", "cosine", "--model")
#: ratio -> what it may be
BOUNDS = {"sampling": 1.03, "warm furnace": 1.15, "translation": 0.5}


def sampling(model: mb.Model) -> Callable[[], None]:
    """A by cosine sampling."""
    p = model.parameters()

    def work() -> None:
        mb.directional_albedo(model, p, 60.0, sampler="cosine", samples=SAMPLES)

    return work


def process(*arguments: str, **more: str) -> Callable[[], None]:
    """A process of its own."""

    def work() -> None:
        environment = {**os.environ, **more}
        subprocess.run([sys.executable, *arguments], env=environment, capture_output=True)

    return work


def fresh(shader: Path) -> Callable[[], None]:
    """A translation that nobody has kept."""

    def work() -> None:
        with tempfile.TemporaryDirectory() as folder:
            os.environ["BRDF_CHECK_CACHE_DIR"] = folder
            translation.translated(shader)

    return work


def seconds(work: Callable[[], None]) -> float:
    """Processor time of this process and its children."""
    before = spent()
    work()
    return spent() - before


def spent() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def ratio(one: Callable[[], None], other: Callable[[], None]) -> float:
    """Of the smallest times, taken in turn after one round that warms up."""
    times = [(seconds(one), seconds(other)) for _ in range(ROUNDS + 1)][1:]
    return min(a for a, _ in times) / min(b for _, b in times)


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        os.environ["BRDF_CHECK_CACHE_DIR"] = folder
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = folder
        file = Path(folder) / "ggx.py"
        file.write_text(PYTHON, encoding="utf-8")
        shader, python = mb.load(str(SHADER)), mb.load(str(file))
        found = {"sampling": ratio(sampling(shader), sampling(python))}
        command = ("-m", "montecarlo_brdf", *FURNACE)
        both = (process(*command, str(path)) for path in (SHADER, file))
        found["warm furnace"] = ratio(*both)
        found["translation"] = ratio(fresh(LONG), process("-c", "import numba"))
    for name, value in found.items():
        print(f"{name}: {value:.2f} (at most {BOUNDS[name]})")
    return int(any(found[name] > bound for name, bound in BOUNDS.items()))


if __name__ == "__main__":
    sys.exit(main())
