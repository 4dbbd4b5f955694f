"""Are the error bars of charts and methods honest? Coverage over 1,000 seeds, case by case.

For every built-in model, verified parameter set, angle and method that "auto" would try: how often
the 95 % interval of 16 replicates holds the reference at 256 to 16,384 samples, unless the
tool declares the method unfit there; and how often an adaptive estimate ends within its target.
A coverage is too low when 1,000 honest seeds would show it with a chance below 1e-6.

Slow adaptive estimates are asked less often: a case may take some seconds.

    python scripts/coverage_of_methods.py [SEEDS]

Resumable: models that scripts/results/coverage_of_methods.json holds are not asked again.
"""
from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import loading, references
from montecarlo_brdf.estimate import adaptive, evaluate, trust
from montecarlo_brdf.estimate.ascent import Ascent
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.trust import measured
from montecarlo_brdf.sampling.points import NONE, SHAPES
from montecarlo_brdf.statistics import Estimate, estimate
from montecarlo_brdf.vectors import from_degrees

RESULTS = Path(__file__).parent / "results" / "coverage_of_methods.json"
REPLICATES = 16
SIZES = (16, 64, 256, 1024)  # samples of a replicate
ANGLES = (0.0, 60.0, 85.0)
TARGET = 1e-6
#: relative accuracy of what models fit by series (models/_energy.py), which references know better
FITTED = {"ggx_kulla_conty": 1e-10, "ggx_turquin": 1e-10}
#: processor seconds that the adaptive estimates of a case may take, and how many are made anyway
PATIENCE = 5.0
FEWEST = 20


def lowest(seeds: int) -> float:
    """The coverage that honest seeds fall below with a chance of 1e-6 (normal approximation)."""
    return 0.95 - 4.75 * math.sqrt(0.95 * 0.05 / seeds)


def cases(name: str) -> Iterator[tuple[Any, Any, float]]:
    """Every verified parameter set and angle of a model."""
    model = mb.load(name)
    for p in model.verified or (model.parameters(),):
        for theta in ANGLES:
            yield model, model.parameters(**p._asdict()), theta


def drawn(setting: adaptive.Setting, wo: Any, size: int, seeds: int) -> list[Estimate]:
    """Estimates of 16 replicates each, with the error bars that reports show."""
    points = setting.method.points
    shape = SHAPES[points](size) if points in SHAPES else NONE
    reals = (*wo, setting.width, *setting.numbers)
    job = evaluate.Job(setting.means(), reals, 1, size, REPLICATES * seeds, size, shape)
    rows = evaluate.run(job)[0]
    return [estimate(rows[i : i + REPLICATES]) for i in range(0, len(rows), REPLICATES)]


def coverage(
    setting: adaptive.Setting,
    demanded: float,
    sight: Any,
    wo: Any,
    truth: Any,
    size: int,
    seeds: int,
) -> float | str:
    """The fraction of seeds whose 95 % interval holds the reference, whose own error is allowed
    for; or why the method is not used: a probe demands more, or the judge of samplers does."""
    if demanded > size:
        return f"unfit: a probe demands {demanded:.0f}"
    found, sampler = drawn(setting, wo, size, seeds), setting.method.sampler
    if sampler in ("own", "cosine"):
        seen = [measured(sampler, e, sight) for e in found]
        if seen[0].unfit:
            return f"unfit: {seen[0].unfit}"
        found = [m.estimate for m in seen]
    return sum(abs(e.mean - truth.value) <= e.half_width(0.05) + truth.error for e in found) / seeds


def need(setting: adaptive.Setting, wo: Any) -> float:
    """Samples of a replicate that the probe demands."""
    ascent = Ascent(setting, wo, Plan(target_error=0.5, replicates=REPLICATES), math.inf)
    ascent.look(1)
    return ascent.need


def look(model: Any, p: Any, theta: float, seeds: int) -> Iterator[dict[str, Any]]:
    """One row per method of a case, and one for its adaptive estimates."""
    variant, wo = model.of(p), from_degrees(theta)
    truth = references.albedo(variant.name, wo[2], **p._asdict(), **variant.picks)
    if truth is None or truth.value == 0.0:
        return
    truth = truth._replace(error=truth.error + FITTED.get(model.name, 0.0) * truth.value)
    case = {"model": model.name, "p": p._asdict(), "theta_o": theta}
    sight = trust.look(variant, p, wo)
    for method in adaptive.methods(variant):
        setting = adaptive.prepare(variant, p, type(p), method)
        demanded = need(setting, wo)
        found = {
            REPLICATES * n: coverage(setting, demanded, sight, wo, truth, n, seeds) for n in SIZES
        }
        name = f"{method.sampler} x {method.points}"
        yield {**case, "method": name, "probed": setting.probed, "coverage": found}
    yield {**case, "method": "adaptive", **ends(model, p, theta, truth, seeds)}


def ends(model: Any, p: Any, theta: float, truth: Any, seeds: int) -> dict[str, int]:
    """How many adaptive estimates were asked, reached their target, and were within it."""
    slack = TARGET * truth.value + truth.error
    asked, ended, within, began = 0, 0, 0, time.process_time()
    while asked < seeds and (asked < FEWEST or time.process_time() - began < PATIENCE):
        e = mb.directional_albedo(model, p, theta, target_error=TARGET, seed=asked)
        reached = "only reached" not in e.method and e.stderr <= TARGET * truth.value
        asked, ended = asked + 1, ended + reached
        within += reached and abs(e.mean - truth.value) <= slack
    return {"asked": asked, "ended": ended, "within": within}


def is_low(row: dict[str, Any], seeds: int) -> bool:
    """Whether an error bar is too small, or adaptive estimates miss too often."""
    low = lowest(seeds)
    return (
        any(isinstance(c, float) and c < low for c in row.get("coverage", {}).values())
        or row.get("within", 0) < 0.985 * row.get("ended", 0)
    )


def rows_of(name: str, seeds: int) -> list[dict[str, Any]]:
    """All rows of a model."""
    rows: list[dict[str, Any]] = []
    for model, p, theta in cases(name):
        rows += look(model, p, theta, seeds)
    return rows


def recorded(seeds: int) -> dict[str, Any]:
    """Rows per model of an earlier run with as many seeds."""
    found = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    return found["cases"] if found.get("seeds") == seeds else {}


def record(done: dict[str, list[dict[str, Any]]], seeds: int) -> None:
    """Write what there is."""
    rows = [row for found in done.values() for row in found]
    summary = {
        "seeds": seeds,
        "lowest allowed": lowest(seeds),
        "rows": len(rows),
        "adaptive asked": sum(r.get("asked", 0) for r in rows),
        "adaptive ended": sum(r.get("ended", 0) for r in rows),
        "adaptive within": sum(r.get("within", 0) for r in rows),
        "low": [row for row in rows if is_low(row, seeds)],
    }
    RESULTS.write_text(json.dumps({**describe(), **summary, "cases": done}, indent=1))


def main() -> None:
    """Look at all cases, model by model, and record them."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    done = recorded(seeds)
    for name in loading.names():
        if name not in done:
            done[name] = rows_of(name, seeds)
            record(done, seeds)
            low = [row for row in done[name] if is_low(row, seeds)]
            print(name, len(done[name]), "rows, low:", low, flush=True)


if __name__ == "__main__":
    main()
