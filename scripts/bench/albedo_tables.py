"""E(mu, alpha) of GGX, 64 x 64 cells to 1e-6: `table`, a plain loop in numba, and dblquad, in turn.

The loop is what people write for such tables: half vectors from GGX by Hammersley's points, twice
as many until the error is there, which it is told by the reference (it knows nothing itself; the
time of smaller numbers of points is not counted). dblquad integrates over the angles, with a
compiled integrand, and is asked for 1e-7. Both are asked for some of the cells, at random and the
same in all rounds, and scaled to all; a cell that does not get there within the limit counts with
the limit. Times are the processor's, without compiling; ratios are medians over rounds.

    python scripts/bench/albedo_tables.py [ROUNDS]
"""

from __future__ import annotations

import json
import math
import statistics
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent.parent))

import numba
import numpy as np
from environment import describe
from scipy.integrate import IntegrationWarning, dblquad

import montecarlo_brdf as mb
from montecarlo_brdf import references
from montecarlo_brdf.table.axes import Axis, checked
from montecarlo_brdf.table.cell import Terms
from montecarlo_brdf.table.cells import filled
from montecarlo_brdf.table.subject import Subject, measures_of

TARGET = Path(__file__).parent.parent / "results" / "bench_tables.json"
SIZE, ERROR, CONFIDENCE = 64, 1e-6, 0.99
LOOPED, INTEGRATED = 24, 8  # cells that the others are asked for
MOST_POINTS, FIRST_POINTS = 1 << 24, 1 << 10
AXES = checked([Axis("mu", 0.0, 1.0, SIZE), Axis("alpha", 0.0, 1.0, SIZE)])
SUBJECT = Subject(mb.load("ggx"), AXES, measures_of(["albedo"]))


@numba.njit
def reversed_bits(i: int) -> float:
    """Van der Corput's sequence."""
    x, half = 0.0, 0.5
    while i > 0:
        x += half * (i & 1)
        half *= 0.5
        i >>= 1
    return x


@numba.njit
def looped(mu: float, alpha: float, n: int) -> float:
    """The mean of f cos/pdf over half vectors drawn from GGX."""
    vx, vz, a2, total = math.sqrt(1.0 - mu * mu), mu, alpha * alpha, 0.0
    for i in range(n):
        u, phi = reversed_bits(i), 2.0 * math.pi * (i + 0.5) / n
        hz = math.sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u))
        hx = math.sqrt(1.0 - hz * hz) * math.cos(phi)
        vh = vx * hx + vz * hz
        lz = 2.0 * vh * hz - vz
        if lz > 0.0 and vh > 0.0:
            lv = lz * math.sqrt(vz * vz * (1.0 - a2) + a2)
            ll = vz * math.sqrt(lz * lz * (1.0 - a2) + a2)
            total += 2.0 * vh * lz / ((lv + ll) * hz)
    return total / n


@numba.njit
def integrand(phi: float, theta: float, mu: float, alpha: float) -> float:
    """f cos sin of GGX, over the angles of the light."""
    s, lz, a2 = math.sin(theta), math.cos(theta), alpha * alpha
    hx, hy, hz = math.sqrt(1.0 - mu * mu) + s * math.cos(phi), s * math.sin(phi), mu + lz
    c = hz * hz / (hx * hx + hy * hy + hz * hz)
    d = a2 / (math.pi * (c * (a2 - 1.0) + 1.0) ** 2)
    lv = lz * math.sqrt(mu * mu * (1.0 - a2) + a2)
    ll = mu * math.sqrt(lz * lz * (1.0 - a2) + a2)
    return 0.5 * d / (lv + ll) * lz * s


def truth(mu: float, alpha: float) -> float:
    """The reference's."""
    found = references.albedo("ggx", mu, alpha=alpha, f0=1.0)
    assert found is not None
    return found.value


def ours() -> tuple[float, float]:
    """(processor seconds of all cells, largest certificate)."""
    began = time.process_time()
    found = filled(SUBJECT, Terms(ERROR, (1.0 - CONFIDENCE) / SIZE**2))
    return time.process_time() - began, float(found.errors.max())


def loop(mu: float, alpha: float) -> tuple[float, bool]:
    """(processor seconds of the fewest points that are enough, whether any are)."""
    known, n = truth(mu, alpha), FIRST_POINTS
    while True:
        began = time.process_time()
        found = looped(mu, alpha, n)
        spent = time.process_time() - began
        if abs(found - known) <= ERROR or n >= MOST_POINTS:
            return spent, abs(found - known) <= ERROR
        n *= 2


def quadrature(mu: float, alpha: float) -> tuple[float, bool]:
    """The same of dblquad, over half of the hemisphere, which is symmetric."""
    began = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", IntegrationWarning)
        found, _ = dblquad(integrand, 0.0, 0.5 * math.pi, 0.0, math.pi, (mu, alpha), 1e-7, 1e-7)
    spent = time.process_time() - began
    return spent, abs(2.0 * found - truth(mu, alpha)) <= ERROR


def scaled(one: Callable[[float, float], tuple[float, bool]], many: int) -> dict[str, Any]:
    """Seconds of all cells by those of some, and how many of these got there."""
    rng = np.random.default_rng(11)
    values = [axis.values() for axis in AXES]
    rows = [one(values[0][i], values[1][j]) for i, j in rng.integers(SIZE, size=(many, 2))]
    total = sum(spent for spent, _ in rows) * SIZE**2 / many
    return {"seconds": total, "cells": many, "reached": sum(there for _, there in rows)}


def main() -> None:
    """Rounds in turn."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    ours(), looped(0.5, 0.5, 2), integrand(0.1, 0.1, 0.5, 0.5)
    found = []
    for _ in range(rounds):
        seconds, worst = ours()
        found.append({"table": {"seconds": seconds, "certificate": worst},
                      "numba": scaled(loop, LOOPED), "dblquad": scaled(quadrature, INTEGRATED)})
    ratios = {
        name: statistics.median(r[name]["seconds"] / r["table"]["seconds"] for r in found)
        for name in ("numba", "dblquad")
    }
    told = {**describe(), "rounds": found, "ratios": ratios}
    TARGET.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    for name, ratio in ratios.items():
        last = found[-1][name]
        print(f"{name}: {ratio:.3g} times the processor time of table "
              f"({last['seconds']:.3g} s against {found[-1]['table']['seconds']:.3g} s; "
              f"{last['reached']} of {last['cells']} cells reached {ERROR:g})")


if __name__ == "__main__":
    main()
