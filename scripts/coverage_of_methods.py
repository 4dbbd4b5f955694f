"""Are the error bars of charts and methods honest? Coverage over 1,000 seeds, case by case.

For every built-in model, verified parameter set, angle and method that "auto" would try: how often
the 95 % interval of 16 replicates holds the reference at 256, 1,024 and 4,096 samples, unless the
probe declares the method unfit there; and how often an adaptive estimate ends within its target.
A coverage is too low when 1,000 honest seeds would show it with a chance below 1e-6.

    python scripts/coverage_of_methods.py [SEEDS]
"""
from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import loading, references, student
from montecarlo_brdf.integration import methods, work
from montecarlo_brdf.integration.ascent import Ascent
from montecarlo_brdf.integration.compiled import compiled
from montecarlo_brdf.integration.plan import Plan
from montecarlo_brdf.sampling.points import NONE, SHAPES
from montecarlo_brdf.statistics import FLOOR
from montecarlo_brdf.vectors import from_degrees

RESULTS = Path(__file__).parent / "results" / "coverage_of_methods.json"
REPLICATES = 16
SIZES = (16, 64, 256)  # samples of a replicate
ANGLES = (0.0, 60.0, 85.0)
TARGET = 1e-6
QUANTILE = student.quantile(0.025, REPLICATES - 1)


def lowest(seeds: int) -> float:
    """The coverage that honest seeds fall below with a chance of 1e-6 (normal approximation)."""
    return 0.95 - 4.75 * math.sqrt(0.95 * 0.05 / seeds)


def cases() -> Iterator[tuple[Any, Any, float]]:
    """Every model, verified parameter set and angle."""
    for name in loading.names():
        model = mb.load(name)
        for p in model.verified or (model.parameters(),):
            for theta in ANGLES:
                yield model, model.parameters(**p._asdict()), theta


def coverage(setting: methods.Setting, wo: Any, truth: Any, size: int, seeds: int) -> float:
    """The fraction of seeds whose 95 % interval, 16 replicates each, holds the reference."""
    points = setting.means.points
    shape = SHAPES[points](size) if points in SHAPES else NONE
    reals = (*wo, setting.width, *setting.numbers)
    entry = compiled(setting.model, setting.means)
    job = work.Job(entry, reals, 1, size, REPLICATES * seeds, size, shape)
    means = [moments.mean for moments in work.run(job)[0]]
    return sum(
        holds(means[i : i + REPLICATES], truth) for i in range(0, len(means), REPLICATES)
    ) / seeds


def holds(means: list[float], truth: Any) -> bool:
    """Whether the interval of some replicates holds the truth, whose own error is allowed for."""
    mean = math.fsum(means) / REPLICATES
    spread = math.fsum([(m - mean) ** 2 for m in means])
    bar = max(math.sqrt(spread / (REPLICATES * (REPLICATES - 1))), FLOOR * abs(mean))
    return abs(mean - truth.value) <= QUANTILE * bar + truth.error


def need(setting: methods.Setting, wo: Any) -> float:
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
    case = {"model": model.name, "p": p._asdict(), "theta_o": theta}
    for method in methods.methods(variant):
        setting = methods.prepare(variant, p, type(p), method)
        demanded = need(setting, wo)
        found = {
            REPLICATES * n: coverage(setting, wo, truth, n, seeds) if demanded <= n else "unfit"
            for n in SIZES
        }
        name = f"{method.sampler} x {method.points}"
        yield {**case, "method": name, "probed": setting.probed, "coverage": found}
    slack = TARGET * truth.value + truth.error
    ended = [
        abs(e.mean - truth.value) <= slack
        for s in range(seeds)
        if "only reached"
        not in (e := mb.directional_albedo(model, p, theta, target_error=TARGET, seed=s)).method
        if e.stderr <= TARGET * truth.value
    ]
    yield {**case, "method": "adaptive", "within": sum(ended), "ended": len(ended)}


def failures(rows: list[dict[str, Any]], seeds: int) -> list[dict[str, Any]]:
    """Rows whose error bar is too small, or whose adaptive estimates miss too often."""
    low = lowest(seeds)
    return [
        row
        for row in rows
        if any(c != "unfit" and c < low for c in row.get("coverage", {}).values())
        or row.get("within", 0) < 0.985 * row.get("ended", 0)
    ]


def main() -> None:
    """Look at all cases and record them."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    rows: list[dict[str, Any]] = []
    for model, p, theta in cases():
        for row in look(model, p, theta, seeds):
            rows.append(row)
            if failures([row], seeds):
                print("LOW", row, flush=True)
    bad = failures(rows, seeds)
    summary = {"seeds": seeds, "lowest allowed": lowest(seeds), "rows": len(rows), "low": bad}
    RESULTS.write_text(json.dumps({**describe(), **summary, "cases": rows}, indent=1))
    print(len(rows), "rows,", len(bad), "low")


if __name__ == "__main__":
    main()
