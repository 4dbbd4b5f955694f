"""Is `resolves` true? Models scaled by what the report says it would catch, and by half of that.

For every two-sided mean of `run` (albedo, radiance, mass of the pdf): `resolves` as the report of
the default seed states it, in units of the value. Then the model's values are scaled by 1 +- that
and by 1 +- half of that, the expected value staying what it is, and judged again with 100 other
seeds at default settings. Asked: at least 88 refuted of 100, and at most 50.

    python scripts/resolves.py [--seeds 100] [--models ggx,phong]
"""
from __future__ import annotations

import argparse
import functools
import json
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from environment import describe

import montecarlo_brdf as mb
from montecarlo_brdf import checks
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.samplers import BLIND
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import Kind, MeanClaim
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.verify.run import SAMPLES

TARGET = Path(__file__).parent / "results" / "resolves.json"
CASES = (
    ("lambert", {}),
    ("oren_nayar", {}),
    ("disney_diffuse", {}),
    ("phong", {}),
    ("ggx", {}),
    ("ggx", {"alpha": 0.05}),
    ("beckmann", {}),
)
ANGLES = (45.0, 80.0)
CHECKS = ("furnace", "radiance", "pdf")


def claims(name: str, parameters: dict[str, float]) -> Iterator[MeanClaim]:
    """The two-sided means of a model, each measured at most once per plan."""
    model = mb.load(name)
    one = model.parameters(**parameters)
    case = Case(model.of(one), one, ANGLES)
    for check in CHECKS:
        for claim in checks.find(check).claims(case):
            if isinstance(claim, MeanClaim) and claim.bound == "equal" and claim.expected:
                yield replace(claim, measure=functools.cache(claim.measure))


def scaled(claim: MeanClaim, factor: float) -> MeanClaim:
    """The claim about a model all of whose values (and error bars) are `factor` times as large;
    where a quadrature says what f should give, those that its sampler draws: what f alone gives
    refutes the quadrature, not the model."""
    same_f = claim.expected and claim.expected.kind == Kind.SAME_F

    def measure(plan: Plan) -> list[Measurement]:
        found = claim.measure(plan)
        keep = [bool(same_f and m.estimator in BLIND) for m in found]
        return [m if k else _scaled(m, factor) for m, k in zip(found, keep, strict=True)]

    return replace(claim, measure=measure, fallback=None)


def _scaled(m: Measurement, factor: float) -> Measurement:
    e = m.estimate
    larger = e._replace(mean=e.mean * factor, stderr=e.stderr * factor, largest=e.largest * factor)
    larger = larger._replace(second_moment=e.second_moment * factor * factor)
    return m._replace(estimate=larger)


def refuted(claim: MeanClaim, factor: float, seeds: int) -> int:
    """How many of `seeds` seeds refute the scaled model."""
    wrong = scaled(claim, factor)
    plans = (Plan(samples=SAMPLES, seed=seed) for seed in range(1, seeds + 1))
    return sum(decide(wrong, plan).verdict == "fail" for plan in plans)


def examined(claim: MeanClaim, seeds: int) -> dict[str, Any]:
    """How often each scaling is refuted."""
    finding = decide(claim, Plan(samples=SAMPLES))
    assert finding.resolves and claim.expected
    relative = finding.resolves / abs(claim.expected.value)
    counts = {
        f"{share:+g}": refuted(claim, 1.0 + share * relative, seeds)
        for share in (1.0, -1.0, 0.5, -0.5)
    }
    holds = min(counts["+1"], counts["-1"]) >= 0.88 * seeds
    holds &= max(counts["+0.5"], counts["-0.5"]) <= 0.5 * seeds
    return {
        "quantity": claim.quantity,
        "where": dict(claim.where),
        "verdict": finding.verdict,
        "estimator": finding.estimator,
        "samples": finding.samples,
        "resolves, relative": relative,
        "tolerance, relative": claim.tolerance / abs(claim.expected.value),
        "refuted": counts,
        "holds": bool(holds),
    }


def main() -> None:
    """Examine all cases and write the result after each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--models", default="")
    options = parser.parse_args()
    wanted, rows, started = options.models.split(","), [], time.process_time()
    for name, parameters in CASES:
        if options.models and name not in wanted:
            continue
        for claim in claims(name, parameters):
            row = {"model": name, "parameters": parameters, **examined(claim, options.seeds)}
            rows.append(row)
            print(*row.values(), flush=True)
        result = {**describe(), "seeds": options.seeds, "all hold": all(r["holds"] for r in rows)}
        result |= {"processor seconds": round(time.process_time() - started, 1), "findings": rows}
        TARGET.write_text(json.dumps(result, indent=1, allow_nan=False))


if __name__ == "__main__":
    main()
