"""Furnace verdicts of every model, verified parameter set, angle and sampler, each sampler alone.

A fail is a false alarm (unless the model disclaims energy); an estimator that cannot resolve its
case must say so and leave the claim inconclusive. Where the tool asks for more samples it gets them
("pass, 2^24 samples"); the reasons of those not used are counted. Writes
scripts/results/furnace_grid.json, in which rows of models that were not asked for stay.

    python scripts/furnace_grid.py [--models lambert,ggx] [--seeds 1]
"""
from __future__ import annotations

import argparse
import collections
import json
import re
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import loading
from montecarlo_brdf.estimate.samplers import samplers_of

TARGET = Path(__file__).parent / "results" / "furnace_grid.json"
ANGLES = [0.0, 30.0, 60.0, 85.0, 89.0]
MOST, MORE = 1 << 22, 1 << 24


def sets(model: Any) -> list[Any]:
    """The verified parameter sets as the model's own kind, and its defaults."""
    verified = [model.parameters(**p._asdict()) for p in model.verified]
    return verified or [model.parameters()]


def counted(model: Any, sampler: str, seed: int) -> collections.Counter[str]:
    """Verdicts of A, with the reasons where there is none."""
    counts: collections.Counter[str] = collections.Counter()
    for p in sets(model):
        for angle in ANGLES:
            finding = verdict_of(model, p, angle, sampler, seed)
            verdict, note = finding.verdict, finding.note or ""
            if verdict == "inconclusive" and note.startswith("undecided"):
                verdict = with_more(verdict_of(model, p, angle, sampler, seed, MORE))
            elif verdict == "inconclusive":
                verdict = f"not used: {note.partition(':')[0]}"
            elif verdict == "fail":
                print("FAIL", model.name, sampler, seed, p, angle)
            counts[verdict] += 1
    return counts


def with_more(finding: Any) -> str:
    """The verdict where more samples were asked for, or that far more would be needed."""
    need = re.search(r"needs about (\S+?),", finding.note or "")
    if finding.verdict == "inconclusive" and need and float(need[1]) > MORE:
        return f"not used: resolves the tolerance with more than {MORE} samples only"
    return f"{finding.verdict}, {MORE} samples"


def verdict_of(model: Any, p: Any, angle: float, sampler: str, seed: int, most: int = MOST) -> Any:
    """The finding about A."""
    report = mb.furnace(model, p, [angle], sampler=sampler, seed=seed, samples=most)
    return next(f for f in report.results[0].findings if f.quantity == "A")


def main() -> None:
    """Count verdicts per model and sampler, and print what is not a pass."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", default=",".join(loading.names()))
    parser.add_argument("--seeds", type=int, default=1)
    options = parser.parse_args()
    table = json.loads(TARGET.read_text())["verdicts of A"] if TARGET.exists() else {}
    for name in options.models.split(","):
        model = mb.load(name)
        for sampler in samplers_of(model):
            counts: collections.Counter[str] = collections.Counter()
            for seed in range(options.seeds):
                counts += counted(model, sampler, seed)
            table[f"{name} {sampler}"] = dict(counts)
            print(f"{name:24} {sampler:8} {dict(counts)}", flush=True)
            found = {**describe(), "verdicts of A": dict(sorted(table.items()))}
            TARGET.write_text(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
