"""How long a picture takes, and how flat lossless spheres are: python scripts/bench_render.py OUT

Whole processes, warm (kernels compiled, bytecode written), wall clock and processor time, the
median of some runs; then spheres of all lossless models in a furnace of 0.5.
"""

import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import loading
from montecarlo_brdf.scene.read import scene_of
from montecarlo_brdf.scene.render import render

RUNS = 7
PICTURES = {
    "one GGX lobe, constant light": ["--model", "ggx", "--environment", "constant"],
    "Lambert, constant light": ["--model", "lambert", "--environment", "constant"],
    "GGX furnace with its difference panel": ["--model", "ggx", "--furnace"],
}


def seconds(arguments: list[str], folder: str) -> dict[str, float]:
    """Medians of whole runs of `brdf-check render` at 512 x 512."""
    words = [sys.executable, "-m", "montecarlo_brdf", "render", *arguments]
    words += ["-o", str(Path(folder) / "s.png")]
    settings = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env=settings)
    walls, used = [], []
    for _ in range(RUNS):
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env=settings)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        walls.append(time.perf_counter() - start)
        used.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return {
        "wall": round(statistics.median(walls), 3),
        "processor": round(statistics.median(used), 3),
        "shortest wall": round(min(walls), 3),
    }


def flatness() -> dict[str, float]:
    """The largest |L - 0.5| on the sphere of every lossless parameter set."""
    found: dict[str, float] = {}
    for name in loading.names():
        model: Any = mb.load(name)
        for p in model.lossless or ():
            scene = scene_of(model.of(p), p, "constant:0.5")
            values = render(scene, size=256, threads=2).values
            found[f"{name} {tuple(p)}"] = float(np.abs(values - 0.5).max())
    return found


def main() -> None:
    """Measure and record."""
    with tempfile.TemporaryDirectory() as folder:
        times = {name: seconds(words, folder) for name, words in PICTURES.items()}
    result = {
        "environment": describe(),
        "seconds at 512 x 512": times,
        "largest |L - 0.5| in a furnace of 0.5": flatness(),
    }
    text = json.dumps(result, indent=1)
    Path(sys.argv[1]).write_text(text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
