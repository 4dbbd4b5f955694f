"""Furnace verdicts of every model, verified parameter set, angle and sampler, each sampler alone.

A fail is a false alarm (unless the model disclaims energy); an estimator that cannot resolve its
case must say so and leave the claim inconclusive. Writes scripts/results/furnace_grid.json.

    python scripts/furnace_grid.py [--models lambert,ggx] [--seeds 1]
"""
from __future__ import annotations

import argparse
import collections
import json
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import loading
from montecarlo_brdf.integration.estimators import samplers_of

TARGET = Path(__file__).parent / "results" / "furnace_grid.json"
ANGLES = [0.0, 30.0, 60.0, 85.0, 89.0]


def sets(model: Any) -> list[Any]:
    """The verified parameter sets as the model's own kind, and its defaults."""
    verified = [model.parameters(**p._asdict()) for p in model.verified]
    return verified or [model.parameters()]


def main() -> None:
    """Count verdicts per model and sampler, and print what is not a pass."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", default=",".join(loading.names()))
    parser.add_argument("--seeds", type=int, default=1)
    options = parser.parse_args()
    table: dict[str, dict[str, int]] = {}
    for name in options.models.split(","):
        model = mb.load(name)
        for sampler in samplers_of(model):
            counts: collections.Counter[str] = collections.Counter()
            for seed in range(options.seeds):
                report = mb.furnace(model, sets(model), ANGLES, sampler=sampler, seed=seed)
                for result in report.results:
                    for f in result.findings:
                        if f.quantity == "A":
                            counts[f.verdict] += 1
                        if f.verdict == "fail":
                            print("FAIL", name, sampler, seed, result.params, f.quantity, f.where)
            table[f"{name} {sampler}"] = dict(counts)
            print(f"{name:24} {sampler:8} {dict(counts)}", flush=True)
    TARGET.write_text(json.dumps({**describe(), "verdicts of A": table}, indent=1))


if __name__ == "__main__":
    main()
