"""Tables at module level, of any size and layout, in code that another process finds on disk."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

MODEL = """
import math
from typing import NamedTuple

import numpy as np


class Params(NamedTuple):
    scale: float = 1.0


COLUMN = np.linspace(0.1, 0.4, 192).reshape(64, 3)[:, 1]
REVERSED = np.linspace(0.5, 1.0, 64)[::-1]
LARGE = np.linspace(0.9, 1.0, 200_000)  # 1.6 MB
PAIR = (COLUMN, REVERSED)


def f(wo, wi, p):
    k = int(wo[2] * 63.0)
    return p.scale * COLUMN[k] * REVERSED[k] * PAIR[1][k] * LARGE[3000 * k] / math.pi
"""
ASK = """
import sys
import montecarlo_brdf as mb
from montecarlo_brdf.vectors import from_degrees
model = mb.load(sys.argv[1])
p = model.parameters()
wo = from_degrees(60.0)
truth = model.f(wo, wo, p) * 3.141592653589793
print(mb.directional_albedo(model, p, 60.0, samples=4096, sampler="cosine").mean / truth)
"""


def test_tables_are_the_same_in_the_next_process(tmp_path: Path) -> None:
    """numba keeps the address of one with gaps or of more than 1 MB: the next process crashed."""
    model = tmp_path / "tables.py"
    model.write_text(MODEL, encoding="utf-8")
    env = {**os.environ, "BRDF_CHECK_CACHE_DIR": str(tmp_path / "cache")}
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", ASK, str(model)], env=env, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
        assert float(done.stdout) == pytest.approx(1.0, rel=1e-14)
    assert list((tmp_path / "cache").glob("**/*.o"))
