"""No false fail: random claims of `run` at default settings, all built-in models, many seeds.

The claims of a model are made once, as `run` makes them for its default seed (with the searches for
the worst place in them); then each is decided with fresh random numbers for every seed. Findings
without random numbers in their verdict (laws at given directions, quadratures) are not asked again.

    python scripts/seeds.py [--seeds 100] [--models ggx,phong] [--checks furnace,pdf] [--part 0/2]

Resumable: seeds that scripts/results/seeds.json holds of a model and check are not asked again.
"""
from __future__ import annotations

import argparse
import collections
import fcntl
import json
import time
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import checks, loading
from montecarlo_brdf.cases.case import Case, searched
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import FitClaim, MeanClaim
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.verify.run import ANGLES, SAMPLES

TARGET = Path(__file__).parent / "results" / "seeds.json"
CHECKS = ("furnace", "energy", "radiance", "pdf", "sampling")


def claims(model: Any, check: str) -> list[Any]:
    """The random claims of a check."""
    one = model.parameters()
    variant = model.of(one)
    case = Case(variant, one, ANGLES, free=searched(variant, {}))
    found = checks.find(check).claims(case)
    return [c for c in found if isinstance(c, MeanClaim | FitClaim)]


def asked(model: Any, check: str, first: int, seeds: int) -> dict[str, Any]:
    """Verdicts of seeds first + 1 to seeds."""
    counts: collections.Counter[str] = collections.Counter()
    other: collections.Counter[str] = collections.Counter()
    began, asking = time.process_time(), claims(model, check)
    for seed in range(first + 1, seeds + 1):
        for claim in asking:
            known = model.disclaims.get(claim.property)
            finding = decide(claim, Plan(samples=SAMPLES, seed=seed), known)
            counts[finding.verdict] += 1
            if finding.verdict in ("fail", "inconclusive"):
                other[f"{finding.verdict}: {finding.quantity} {dict(finding.where)}"] += 1
    seconds = round(time.process_time() - began, 1)
    return {"seeds": seeds, "findings": dict(counts), "not passed": dict(other), "seconds": seconds}


def recorded() -> dict[str, Any]:
    """model -> check -> verdicts."""
    found: dict[str, Any] = json.loads(TARGET.read_text())["models"] if TARGET.exists() else {}
    return found


def record(name: str, check: str, more: dict[str, Any]) -> None:
    """Add verdicts to those that there are."""
    with (TARGET.parent / ".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = recorded()
        old = done.setdefault(name, {}).get(check, {"findings": {}, "not passed": {}, "seconds": 0})
        for kind in ("findings", "not passed"):
            more[kind] = dict(collections.Counter(old[kind]) + collections.Counter(more[kind]))
        more["seconds"] += old["seconds"]
        done[name][check] = more
        total: collections.Counter[str] = collections.Counter()
        for row in done.values():
            for found in row.values():
                total.update(found["findings"])
        models = dict(sorted(done.items()))
        result = {**describe(), "all findings": dict(total), "models": models}
        TARGET.write_text(json.dumps(result, indent=1))


def main() -> None:
    """Ask what is missing, a check of all models at a time."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", default=",".join(loading.names()))
    parser.add_argument("--checks", default=",".join(CHECKS))
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--part", default="0/1", help="which of how many processes this is")
    o = parser.parse_args()
    part, parts = map(int, o.part.split("/"))
    for check in o.checks.split(","):
        for name in o.models.split(",")[part::parts]:
            done = recorded().get(name, {}).get(check, {"seeds": 0})["seeds"]
            if done < o.seeds:
                row = asked(mb.load(name), check, done, o.seeds)
                record(name, check, row)
                print(name, check, row, flush=True)


if __name__ == "__main__":
    main()
