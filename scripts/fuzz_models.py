"""Millions of evaluations of every built-in model at random, and where they break.

    python scripts/fuzz_models.py [--evaluations 10000000] [--seed 0] [MODEL ...]

Directions are uniform in the logarithm of the cosine (down to 1e-15) for half of the points, and
uniform on the hemisphere for the rest; parameters uniform in the domain or in its logarithm. A
violation is an f or pdf that is NaN, infinite or negative where the model does not disclaim it, a
sample that is NaN or not of unit length within 1e-14, or a kept sample of density 0.
"""

from __future__ import annotations

import argparse
import math
import time
from typing import Any

import numpy as np

from montecarlo_brdf import loading
from montecarlo_brdf.estimate.places import Pointwise
from montecarlo_brdf.model import Model

AT_ONCE = 1 << 16  # evaluations per parameter set


def directions(rng: np.random.Generator, count: int) -> Any:
    """Half uniform, half close to the horizon."""
    low = 10.0 ** rng.uniform(-15.0, 0.0, count)
    mu = np.where(rng.random(count) < 0.5, rng.random(count), low)
    mu = np.maximum(mu, 1e-15)
    phi = rng.uniform(-math.pi, math.pi, count)
    s = np.sqrt((1.0 - mu) * (1.0 + mu))
    return np.stack([s * np.cos(phi), s * np.sin(phi), mu], axis=1)


def parameters(model: Model, rng: np.random.Generator) -> Any:
    """A random set of the domain."""
    values = {}
    for name, (low, high) in model.domain.items():
        t = rng.random()
        wide = low > 0.0 and high / low > 50.0
        values[name] = low * (high / low) ** t if wide else low + (high - low) * t
        if low == 0.0 and high > 50.0:
            values[name] = min(high, 10.0 ** rng.uniform(-2.0, math.log10(high)))
    return model.parameters(**values)


def violations(model: Model, p: Any, rng: np.random.Generator, count: int) -> dict[str, int]:
    """How often each kind of violation happens in `count` evaluations."""
    points = Pointwise(model, p)
    wo, wi = directions(rng, count), directions(rng, count)
    near = rng.random(count) < 0.5  # half of the pairs within the lobe
    if model.sample:
        drawn, _ = points.sample(wo, rng.random((count, 3)))
        wi = np.where((near & (drawn[:, 2] > 0))[:, None], drawn, wi)
    f = points.f(wo, wi)
    found = {"f NaN or Inf": int((~np.isfinite(f)).sum())}
    if "positivity" not in model.disclaims:
        found["f negative"] = int((f < 0.0).sum())
    if not model.sample or not model.pdf:
        return found
    kept = drawn[:, 2] > 0.0
    density = points.pdf(wo[kept], drawn[kept])
    found["sample NaN"] = int((~np.isfinite(drawn)).any(axis=1).sum())
    off = np.abs(np.linalg.norm(drawn, axis=1) - 1.0)
    found["sample length"] = int((off > 1e-14).sum())
    found["pdf not positive"] = int((~(density > 0.0)).sum())
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("models", nargs="*", default=[])
    parser.add_argument("--evaluations", type=int, default=10_000_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    for name in options.models or loading.names():
        started = time.monotonic()
        model, rng = loading.load(name), np.random.default_rng(options.seed)
        total: dict[str, int] = {}
        first = None
        for _ in range(-(-options.evaluations // AT_ONCE)):
            p = parameters(model, rng)
            found = violations(model, p, rng, AT_ONCE)
            first = first or (p if any(found.values()) else None)
            total = {k: total.get(k, 0) + v for k, v in found.items()}
        bad = {k: v for k, v in total.items() if v}
        count = AT_ONCE * -(-options.evaluations // AT_ONCE)
        seconds = time.monotonic() - started
        print(
            f"{name:24} {count} evaluations, {seconds:.0f} s: {bad or 'none'} {first or ''}",
            flush=True,
        )


if __name__ == "__main__":
    main()
