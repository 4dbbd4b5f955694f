"""Are the bounds of quadrature references true? Random cases against the same rules much finer.

A case is a model with a lobe, its parameters (widths and exponents by their logarithm), choices and
an angle up to 89.99 degrees. Every integral that a reference refines until it is sure is computed
once more with FINER times as many nodes per dimension: it may not differ by more than the bound.

    python scripts/reference_bounds.py [SECONDS] [SEED]
"""
from __future__ import annotations

import collections
import json
import math
import random
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from environment import describe

from montecarlo_brdf import references
from montecarlo_brdf.references import _quadrature, _rules

RESULTS = Path(__file__).parent / "results" / "reference_bounds.json"
FINER = 12.0
ROUGH = ("smith", "separable", "v_cavity", "walter", "walter_correlated")

Case = tuple[str, dict[str, Any]]  # a model and its parameters


def lobe(rng: random.Random) -> Case:
    """Microfacets by alpha."""
    shape = {"distribution": rng.choice(["ggx", "beckmann"]), "masking": rng.choice(ROUGH)}
    f0 = rng.choice([1.0, rng.random()])
    return "cook_torrance", {**shape, "alpha": 10.0 ** rng.uniform(-3.0, 0.0), "f0": f0}


def power(rng: random.Random) -> Case:
    """Microfacets by an exponent."""
    shape = {"distribution": "blinn_phong", "masking": rng.choice(["smith", "v_cavity"])}
    return "cook_torrance", {**shape, "n": 10.0 ** rng.uniform(0.0, 5.0), "f0": rng.random()}


def metal(rng: random.Random) -> Case:
    """A conductor; below an index of 1 its reflection is nearly total beyond an angle."""
    optics = {"fresnel": "conductor", "eta": rng.uniform(0.4, 3.0), "k": rng.uniform(0.0, 4.0)}
    return "cook_torrance", {**optics, "alpha": 10.0 ** rng.uniform(-3.0, 0.0)}


def coupled(rng: random.Random) -> Case:
    """Ashikhmin and Shirley's lobe: larger of two cosines."""
    n = 10.0 ** rng.uniform(0.0, 5.0)
    return "ashikhmin_shirley", {"rd": 0.5, "rs": rng.random(), "n": n}


KINDS: tuple[Callable[[random.Random], Case], ...] = (lobe, lobe, lobe, power, metal, coupled)


class Watch:
    """In place of `converge`: what it returns, and by how many bounds the finer sum differs."""

    def __init__(self) -> None:
        self.seen: list[tuple[float, float]] = []  # (relative difference, in bounds)

    def __call__(self, rule: Callable[[float], Any], **settings: Any) -> tuple[float, float]:
        value, error = _rules.converge(rule, **settings)
        finer = rule(FINER)
        room = _rules.ROUNDING * finer.magnitude  # of the finer sum itself
        off = abs(value - finer.value)
        self.seen.append((off / finer.magnitude, off / (error + room)))
        return value, error


def main() -> None:
    """Ask random cases for some time, and record."""
    seconds, seed = (float(x) for x in (*sys.argv[1:], "120", "1")[:2])
    rng, watch = random.Random(int(seed)), Watch()
    _quadrature.converge = watch  # type: ignore[assignment]
    asked: collections.Counter[str] = collections.Counter()
    missed, until = [], time.monotonic() + seconds
    while time.monotonic() < until:
        kind = rng.choice(KINDS)
        name, given = kind(rng)
        theta = rng.choice([rng.uniform(0.0, 89.9), rng.uniform(80.0, 89.99)])
        watch.seen.clear()
        references.albedo(name, math.cos(math.radians(theta)), **given)
        asked[kind.__name__] += 1
        worst = max(watch.seen, key=lambda s: s[1])
        if worst[1] > 1.0:
            missed.append({"model": name, **given, "theta_o": theta, "off, in bounds": worst})
    print(dict(asked), missed)
    found = {"asked": dict(asked), "outside": missed, "seed": int(seed)}
    RESULTS.write_text(json.dumps({**describe(), **found}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
