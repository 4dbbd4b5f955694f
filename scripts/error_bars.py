"""Coverage of error bars: how often 95 % intervals hold the truth, for every point set and sampler.

Light-tailed cases, 10,000 runs each: coverage of the 95 % and the 99.99 % interval, and whether
standardised errors follow Student's t (Kolmogorov-Smirnov). Then cases where error bars are not
honest (2,000 runs each), with what the tool does about them: calls the estimator unfit, widens the
bar, or confirms.

    python scripts/error_bars.py [--runs 10000]

Resumable: rows that scripts/results/error_bars.json holds are not measured again.
"""
from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import replicates
from environment import describe
from scipy import stats

import montecarlo_brdf as mb
from montecarlo_brdf.checks import _truth
from montecarlo_brdf.estimate import trust
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity, second_moment
from montecarlo_brdf.estimate.samplers import BLIND, functions_of, integrand, query, subject_of
from montecarlo_brdf.judge.mean import CONFIRMING_POINTS, CONFIRMING_REPLICATES
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import from_degrees

TARGET = Path(__file__).parent / "results" / "error_bars.json"
POINTS = ("independent", "stratified", "sobol", "lattice")
REPLICATES = 16
SIZES = (1024, 256, 64)  # samples of a replicate: the first that the reference can judge
SHARPNESS = 0.02  # of a standard error
HONEST = (
    ("lambert", {"albedo": 0.8}, 60.0, "uniform"),
    ("oren_nayar", {"sigma": 0.5}, 50.0, "uniform"),
    ("oren_nayar", {"sigma": 0.5}, 50.0, "cosine"),
    ("ggx", {"alpha": 0.5}, 40.0, "cosine"),
    ("ggx", {"alpha": 0.3}, 50.0, "own"),
    ("phong", {"n": 32.0}, 60.0, "own"),
    ("ggx", {"alpha": 0.3}, 60.0, "half_vector"),
    ("ggx", {"alpha": 0.05}, 80.0, "half_vector"),
    ("phong", {"n": 32.0}, 30.0, "mirror"),
    ("oren_nayar", {"sigma": 0.5}, 60.0, "panels"),
)
#: model, parameters, angle, sampler, point set, samples of a replicate, what is wrong with it
DISHONEST = (
    ("ggx", {"alpha": 0.001}, 60.0, "cosine", "sobol", 1024, "a lobe that is never hit"),
    ("ggx", {"alpha": 0.02}, 60.0, "cosine", "independent", 1024, "a lobe that is seldom hit"),
    ("minnaert", {"k": 0.0}, 60.0, "cosine", "independent", 1024, "infinite variance"),
    ("ggx", {"alpha": 0.001}, 0.0, "own", "sobol", 1024, "a tail too rare to be drawn"),
    ("ggx", {"alpha": 0.01}, 0.0, "own", "independent", 1024, "a tail that is seldom drawn"),
    ("ggx", {"alpha": 0.1}, 75.0, "half_vector", "lattice", 32, "one dominant mode of the lattice"),
)


class Asked(NamedTuple):
    """A case, its question and its truth."""

    model: Any
    one: Any
    theta: float
    sampler: str
    question: replicates.Question
    expected: float
    error: float


def asked(name: str, parameters: dict[str, float], theta: float, sampler: str) -> Asked:
    """The albedo of a case by one sampler."""
    model = mb.load(name)
    one = model.parameters(**parameters)
    known = _truth.albedo(model, one, theta)
    assert known
    function = integrand(model, Quantity.ALBEDO, sampler)
    wo = query(model, one, from_degrees(theta))
    q = replicates.Question(subject_of(model, one), wo, [function], ("coverage", sampler))
    return Asked(model, one, theta, sampler, q, known.value, known.error)


def honest(a: Asked, points: str, runs: int) -> dict[str, Any]:
    """Coverage of `runs` estimates, at the largest size that the reference can judge."""
    for each in SIZES:
        rows = replicates.means(a.question, points, runs * REPLICATES, each=each)[0]
        mean, error = replicates.estimates(rows, REPLICATES, each)
        if a.error < SHARPNESS * np.median(error):
            break
    z = (mean - a.expected) / error
    u = stats.t.cdf(z, REPLICATES - 1)
    return {
        "points": points,
        **_named(a),
        "samples": each * REPLICATES,
        "runs": len(z),
        "relative stderr": float(np.median(error) / abs(a.expected)),
        **covered(z, REPLICATES),
        "Student's t, p": float(stats.kstest(u, "uniform").pvalue),
        "floor active": not replicates.continuous(rows, REPLICATES, each),
        "reference resolves": bool(a.error < SHARPNESS * np.median(error)),
    }


def _named(a: Asked) -> dict[str, Any]:
    changed = ", ".join(f"{k}={v:g}" for k, v in a.one._asdict().items())
    return {"sampler": a.sampler, "case": f"{a.model.name}({changed}), {a.theta:g} deg"}


def covered(z: Any, many: int) -> dict[str, float]:
    """Shares of standardised errors inside the 95 % and the 99.99 % interval."""
    t = [stats.t.isf(miss / 2.0, many - 1) for miss in (0.05, 1e-4)]
    return {"95 %": float(np.mean(np.abs(z) <= t[0])), "99.99 %": float(np.mean(np.abs(z) <= t[1]))}


def dishonest(a: Asked, points: str, each: int, flaw: str, runs: int) -> dict[str, Any]:
    """Coverage of the bare spread, and what becomes of such an estimate in a verdict."""
    rows = replicates.means(a.question, points, runs * REPLICATES, each=each)[0]
    groups = rows[0][: runs * REPLICATES].reshape(-1, REPLICATES)
    spread = groups.std(axis=1, ddof=1) / np.sqrt(REPLICATES)
    z = (groups.mean(axis=1) - a.expected) / np.maximum(spread, 1e-300)
    mean, error = replicates.estimates(rows, REPLICATES, each)
    return {
        "points": points,
        **_named(a),
        "samples": each * REPLICATES,
        "runs": runs,
        "flaw": flaw,
        "bare spread": covered(z, REPLICATES),
        "as reported": covered((mean - a.expected) / error, REPLICATES),
        "confirmation": confirmation(a, each, runs),
        "not used because": unfit(a, points),
    }


def confirmation(a: Asked, each: int, runs: int) -> dict[str, float]:
    """Coverage of what must agree before anything fails: 64 fresh scrambles of Sobol's points."""
    many = CONFIRMING_REPLICATES
    rows = replicates.means(a.question, CONFIRMING_POINTS, runs // 4 * many, each=each)[0]
    mean, error = replicates.estimates(rows, many, each)
    return covered((mean - a.expected) / error, many)


def unfit(a: Asked, points: str) -> str | None:
    """What the judge says of the estimator at its first look."""
    wo = from_degrees(a.theta)
    means = [integrand(a.model, Quantity.ALBEDO, a.sampler)]
    both = a.sampler in BLIND and a.model.sample and a.model.pdf
    means += [second_moment(Sampler(a.sampler), functions_of(a.model))] if both else []
    row = estimates(a.model, a.one, wo, means, Plan(points, 1 << 14), ("coverage",))[0]
    sight = trust.look(a.model, a.one, wo)
    return trust.reason_unfit(a.sampler, row[0], sight, row[1] if both else None)


def recorded() -> dict[str, Any]:
    """What there is already."""
    found: dict[str, Any] = json.loads(TARGET.read_text()) if TARGET.exists() else {}
    return found


def record(kind: str, row: dict[str, Any]) -> None:
    """Add a row."""
    result = recorded()
    result.setdefault(kind, []).append(row)
    TARGET.write_text(json.dumps({**result, **describe()}, indent=1, allow_nan=False))
    print(*row.values(), flush=True)


def known(kind: str, a: Asked, points: str) -> bool:
    """Whether a row is recorded."""
    name = {"points": points, **_named(a)}
    return any(name.items() <= row.items() for row in recorded().get(kind, []))


def main() -> None:
    """Measure what is not recorded yet."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=10_000)
    runs = parser.parse_args().runs
    for *rest, points, each, flaw in DISHONEST:
        a = asked(*rest)
        if not known("dishonest", a, points):
            record("dishonest", dishonest(a, points, each, flaw, min(runs, 2000)))
    for case in HONEST:
        for points in POINTS:
            a = asked(*case)
            if not known("honest", a, points):
                record("honest", honest(a, points, runs))


if __name__ == "__main__":
    main()
