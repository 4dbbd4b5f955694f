"""Power: three small mistakes in GGX (alpha 0.3, 45 degrees), each in thousands of runs.

A pdf 1 % too large, a sampler whose alpha is 2 % off, 0.5 % of energy too much: caught how often,
in which time per run, by the finding meant for it; the honest model's false alarms by the same
findings; and the mass of the pdf and its distance from the draws alone. Every run starts with a
fresh seed and empty tables. Times are of one processor, in process, compiled.

    python scripts/power.py [--runs 3000]
    python scripts/power.py --times --runs 100

Resumable: subjects that scripts/results/power.json holds are not run again.
"""
from __future__ import annotations

import argparse
import collections
import dataclasses
import json
import statistics
import time
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import checks, references
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _density, _draws, _truth
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.models import ggx
from montecarlo_brdf.verify.run import SAMPLES

TARGET = Path(__file__).parent / "results" / "power.json"
THETA = 45.0
MASS, DENSITY, ALBEDO = "int pdf + rejected", "(1 - pdf/density)+", "A"


def pdf_one_percent_large(wo: Any, wi: Any, p: Any) -> float:
    """The density, 1 % too large everywhere."""
    return 1.01 * ggx.pdf(wo, wi, p)


def warp_two_percent_off(wo: Any, u: Any, p: Any) -> Any:
    """Draws of a lobe 2 % wider than the density's."""
    return ggx.sample(wo, u, ggx.Params(1.02 * p.alpha, p.f0))


def half_percent_gain(wo: Any, wi: Any, p: Any) -> float:
    """Values 0.5 % too large."""
    return 1.005 * ggx.f(wo, wi, p)


def declared(mu: float, p: Any) -> float:
    """What a user who knows the albedo declares."""
    known = references.albedo("ggx", mu, **p._asdict())
    assert known
    return known[0]


def subjects() -> dict[str, tuple[Any, str, tuple[str, ...]]]:
    """name -> (model, check, findings to decide)."""
    honest = dataclasses.replace(mb.load("ggx"), built_in=False, albedo=declared)
    change = dataclasses.replace
    return {
        "pdf 1 % too large": (change(honest, pdf=pdf_one_percent_large), "pdf", (MASS,)),
        "warp 2 % off": (change(honest, sample=warp_two_percent_off), "pdf", (DENSITY,)),
        "0.5 % energy gain": (change(honest, f=half_percent_gain), "furnace", (ALBEDO,)),
        "honest, mass of the pdf": (honest, "pdf", (MASS,)),
        "honest, density of draws": (honest, "pdf", (DENSITY,)),
        "honest, albedo": (honest, "furnace", (ALBEDO,)),
    }


def run(model: Any, check: str, findings: tuple[str, ...], seed: int) -> str:
    """The verdict of a run: the worst of the findings, from nothing but compiled code."""
    _draws.density_integral_of.cache_clear()
    _density._look.cache_clear()
    _truth.quadrature.cache_clear()
    p = model.parameters()
    case = Case(model, p, [THETA], seed=seed)
    plan = Plan(samples=SAMPLES, seed=seed)
    verdicts = []
    for claim in checks.find(check).claims(case):
        if claim.quantity in findings:
            verdicts.append(decide(claim, plan).verdict)
            if len(verdicts) == len(findings):
                break
    return max(verdicts, key=("pass", "inconclusive", "fail").index)


def measured(name: str, runs: int) -> dict[str, Any]:
    """Verdicts over `runs` seeds and the time of a run in milliseconds."""
    model, check, findings = subjects()[name]
    run(model, check, findings, 0)  # compiles
    counts: collections.Counter[str] = collections.Counter()
    times = []
    for seed in range(1, runs + 1):
        began = time.perf_counter()
        counts[run(model, check, findings, seed)] += 1
        times.append(1e3 * (time.perf_counter() - began))
    middle, least = statistics.median(times), min(times)
    return {"runs": runs, "verdicts": dict(counts), "times": {"median": middle, "least": least}}


def main() -> None:
    """Count verdicts, or with --times measure how long a run takes, and record either."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3000)
    parser.add_argument("--times", action="store_true", help="for a quiet machine and few runs")
    parser.add_argument("--part", default="0/1", help="which of how many processes this is")
    options = parser.parse_args()
    part, parts = map(int, options.part.split("/"))
    for name in list(subjects())[part::parts]:
        done = recorded().get("subjects", {}).get(name, {})
        if options.times or done.get("runs") != options.runs:
            row = measured(name, options.runs)
            print(name, row, flush=True)
            times = row.pop("times")
            record("times" if options.times else "subjects", name, times if options.times else row)


def recorded() -> dict[str, Any]:
    """What there is already."""
    found: dict[str, Any] = json.loads(TARGET.read_text()) if TARGET.exists() else {}
    return found


def record(kind: str, name: str, row: dict[str, Any]) -> None:
    """Add a row."""
    result = recorded()
    result.setdefault(kind, {})[name] = row
    TARGET.write_text(json.dumps({**result, **describe()}, indent=1))


if __name__ == "__main__":
    main()
