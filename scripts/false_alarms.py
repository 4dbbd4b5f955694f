"""False alarms: p-values at tolerance 0 of honest models, pooled over everything that is random.

All built-in models x up to three of their verified parameter sets x angles x claims (albedo against
its reference, radiance and rejected fraction against a quadrature) x samplers that the judge calls
fit x point sets. Every claim is asked as the judge asks it, with the 2^14 samples of its first
look: looks of 16 replicates, confirmations of 64 stratified ones. (A confirmation takes 4 times as
many, which can only bring its errors closer to Student's t.) Left out, since not continuous:
estimators without variance, and references that are not known to 2 % of a standard error.
Chi-square of draws against pdf gives p-values of its own, for a few models.

    python scripts/false_alarms.py [--models ggx,phong] [--looks 700] [--confirmations 700]

Resumable: a model whose row in scripts/results/false_alarms.json was made with the same settings
and the same package sources is not asked again.
"""
from __future__ import annotations

import argparse
import fcntl
import functools
import hashlib
import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import replicates
from environment import describe
from scipy import stats

import montecarlo_brdf as mb
from montecarlo_brdf import loading
from montecarlo_brdf.cases.case import Case, pointwise
from montecarlo_brdf.checks import _truth, radiance, sampling
from montecarlo_brdf.checks._cells import Cells
from montecarlo_brdf.estimate import trust
from montecarlo_brdf.estimate.evaluate import evaluate
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quadrature import integrate
from montecarlo_brdf.estimate.quantity import Quantity, second_moment
from montecarlo_brdf.estimate.regions import Coordinates
from montecarlo_brdf.estimate.samplers import (
    BLIND,
    functions_of,
    integrand,
    query,
    samplers_of,
    subject_of,
)
from montecarlo_brdf.judge.mean import CONFIRMING_POINTS, CONFIRMING_REPLICATES
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.vectors import from_degrees

ROOT = Path(__file__).parents[1]
TARGET = Path(__file__).parent / "results" / "false_alarms.json"
ANGLES = (20.0, 50.0, 75.0)
POINTS = ("sobol", "stratified", "independent", "lattice")  # every model: the first
EVERY_SET = ("oren_nayar", "ggx")  # ... and these also the others
FITTED = ("lambert", "phong", "ggx", "beckmann")  # chi-square costs most
THRESHOLDS = (1e-3, 1e-4, 1e-5)
SHARPNESS = 0.02  # of a standard error: how well a reference must be known
SAMPLES = 1 << 14  # of every estimate, and two thirds of the draws of every chi-square


class Claim(NamedTuple):
    """A number with its truth, and how each sampler estimates it."""

    kind: str
    question: replicates.Question
    samplers: list[str]  # one per integrand
    expected: float
    error: float
    fit: list[bool]
    known: float = 0.0  # part of the number that is not estimated


def sets(model: Any) -> list[Any]:
    """First, middle and last of the verified parameter sets, or the defaults."""
    found = [model.parameters(**p._asdict()) for p in model.verified] or [model.parameters()]
    return list(dict.fromkeys((found[0], found[len(found) // 2], found[-1])))


def claims(model: Any, one: Any, theta: float) -> Iterator[Claim]:
    """Every kind of mean that `run` judges."""
    wo = from_degrees(theta)
    known = _truth.albedo(model, one, theta)
    if known:
        yield _claim(model, one, wo, "albedo", known.value, known.error)
    lit = functools.partial(_lit, pointwise(model, one).f, np.array(wo))
    found = integrate(lit, Coordinates(wo), 1e-11, _truth.probes(model, one, wo))
    yield _claim(model, one, wo, "radiance", found.value, found.error, SKY=radiance.either_sky)
    if model.sample and model.pdf:
        yield _rejected(model, one, wo)


def _lit(f: Any, wo: Any, wi: Any) -> Any:
    return f(wo, wi) * wi[:, 2] * radiance.tilted_sky(wi.T)


def _claim(
    model: Any, one: Any, wo: Any, kind: str, expected: float, error: float, **sky: Any
) -> Claim:
    chosen = list(samplers_of(model))
    means = [integrand(model, Quantity(kind), s, **sky) for s in chosen]
    blind = [s for s in chosen if s in BLIND]
    seconds = blind if kind == "albedo" and model.sample and model.pdf else []
    means += [second_moment(s, functions_of(model)) for s in seconds]
    fixed = (*wo, radiance.WHICH["tilted"]) if sky else query(model, one, wo)
    q = replicates.Question(subject_of(model, one), fixed, means, ("false alarms", kind))
    row = evaluate(q.subject, q.fixed, means, Plan(samples=SAMPLES), q.label)[0]
    sight = trust.look(model, one, wo)
    moments = dict(zip(seconds, row[len(chosen) :], strict=True))
    fit = [
        trust.reason_unfit(s, e, sight, moments.get(s)) is None
        for s, e in zip(chosen, row, strict=False)
    ]
    return Claim(kind, q, chosen, expected, error, fit)


def _rejected(model: Any, one: Any, wo: Any) -> Claim:
    """The rejected fraction of the sampler and int pdf against 1."""
    pdf, seen = pointwise(model, one).pdf, _truth.probes(model, one, wo)
    found = integrate(lambda wi: pdf(np.array(wo), wi), Coordinates(wo), 1e-11, seen)
    label = ("false alarms", "rejected")
    lost = integrand(model, Quantity.REJECTED, Sampler.OWN)
    q = replicates.Question(subject_of(model, one), wo, [lost], label)
    return Claim("rejected", q, ["own"], 1.0, found.error, [True], known=found.value)


def tested(claim: Claim, points: str, many: int, count: int) -> Iterator[tuple[str, Any]]:
    """(sampler, p-values) of `count` estimates of `many` replicates, where that is continuous."""
    each = SAMPLES // many
    rows = replicates.means(claim.question, points, many * count, each=each)
    rows[:, 0] += claim.known
    for row, sampler, fit in zip(rows, claim.samplers, claim.fit, strict=False):
        typical = float(np.median(replicates.estimates(row, many, each)[1]))
        if fit and claim.error < SHARPNESS * typical and replicates.continuous(row, many, each):
            yield sampler, replicates.p_values(row, many, each, claim.expected, claim.error)


def chi_squares(model: Any, one: Any, theta: float, count: int) -> Any:
    """p-values of draws against pdf, as the fit claim computes them."""
    case = Case(model, one, [theta])
    cells = Cells(case, theta, sampling.TOLERANCE)
    if not 0.0 < cells.mass < sampling.HEAVIEST or SAMPLES * cells.error**2 > 1.0:
        return np.array([])
    ask = functools.partial(sampling.fit, case, theta, cells)
    return np.array([ask(Plan(samples=SAMPLES, seed=s), 1e-9).p_value for s in range(count)])


def study(name: str, looks: int, confirmations: int, fits: int) -> dict[str, Any]:
    """Counts of one model, per kind of question: {row: [number, below 1e-3, 1e-4, 1e-5]}."""
    model = mb.load(name)
    rows: dict[str, Any] = {}
    cases = [(p, theta) for p in sets(model) for theta in ANGLES]
    started = time.process_time()
    for p, theta in cases:
        variant = model.of(p)
        for claim in claims(variant, p, theta):
            replicates.check_against_the_tool(claim.question, "sobol", 16)
            every = claim.kind == "albedo" and name in EVERY_SET
            for points in POINTS if every else POINTS[:1]:
                many = looks if points == "sobol" else -(-looks // 4)
                for sampler, found in tested(claim, points, 16, many):
                    _add(rows, f"look, {points}, {claim.kind}, {sampler}", found)
            if claim.kind == "albedo":
                fresh = tested(claim, CONFIRMING_POINTS, CONFIRMING_REPLICATES, confirmations)
                for sampler, found in fresh:
                    _add(rows, f"confirmation, {claim.kind}, {sampler}", found)
        if name in FITTED:
            _add(rows, "fit", chi_squares(variant, p, theta, -(-fits // len(cases))))
    return {"rows": rows, "processor seconds": round(time.process_time() - started, 1)}


def _add(rows: dict[str, Any], row: str, found: Any) -> None:
    """Count p-values into a row; its last entry is the smallest of them."""
    old = rows.get(row, [0, 0, 0, 0, 1.0])
    below = [int(np.count_nonzero(found < t)) for t in THRESHOLDS]
    new = [len(found), *below]
    lowest = min(old[-1], float(np.min(found, initial=1.0)))
    rows[row] = [a + b for a, b in zip(old, new, strict=False)] + [lowest]


def poisson_bounds(expected: float, level: float = 1e-3) -> tuple[int, int]:
    """Counts that a Poisson number leaves with probability `level` at most."""
    return int(stats.poisson.ppf(level / 2, expected)), int(stats.poisson.isf(level / 2, expected))


def pooled(done: dict[str, Any], pick: Any) -> dict[str, Any]:
    """Counts of all rows that `pick` accepts, with their Poisson bounds."""
    total = np.zeros(4, dtype=int)
    for entry in done.values():
        rows = entry["rows"]
        for row, counts in rows.items():
            same = row.endswith("own") and _equal(counts, rows.get(row[:-3] + "cosine"))
            total += np.array(counts[:4]) if pick(row) and not same else 0
    bounds = [poisson_bounds(total[0] * t) for t in THRESHOLDS]
    inside = [lo <= c <= hi for c, (lo, hi) in zip(total[1:], bounds, strict=True)]
    return {
        "p-values": int(total[0]),
        "below 1e-3, 1e-4, 1e-5": [int(c) for c in total[1:]],
        "bounds": bounds,
        "inside": bool(all(inside)),
    }


def _equal(counts: list[Any], others: list[Any] | None) -> bool:
    """Whether a sampler is another one under its own name: the same draws, counted once."""
    return others is not None and counts[:4] == others[:4] and np.isclose(counts[4], others[4])


def summary(done: dict[str, Any]) -> dict[str, Any]:
    """Looks per point set, confirmations and fits, each pooled over everything else."""
    kinds = {f"look, {p}": f"look, {p}" for p in POINTS}
    kinds |= {"confirmations": "confirmation", "fits": "fit"}
    table = {k: pooled(done, lambda row, v=v: row.startswith(v)) for k, v in kinds.items()}
    table["all but lattices"] = pooled(done, lambda row: "lattice" not in row)
    return table


def sources() -> str:
    """A digest of the package, so that any change of it asks everything again."""
    digest = hashlib.sha256()
    for path in sorted((ROOT / "montecarlo_brdf").rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def main() -> None:
    """Ask the models that are not done yet, and write the result after each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", default=",".join(loading.names()))
    parser.add_argument("--looks", type=int, default=700)
    parser.add_argument("--confirmations", type=int, default=700)
    parser.add_argument("--fits", type=int, default=1000)
    parser.add_argument("--part", default="0/1", help="which of how many processes this is")
    parser.add_argument("--keep", action="store_true", help="keep rows of other package sources")
    o = parser.parse_args()
    settings = [o.looks, o.confirmations, o.fits, sources()]
    part, parts = map(int, o.part.split("/"))
    for name in o.models.split(",")[part::parts]:
        if not current(recorded().get(name), settings, o.keep):
            row = {"settings": settings, **study(name, *settings[:3])}
            total = record(name, row)["all but lattices"]
            print(name, row["processor seconds"], total, flush=True)
    print(json.dumps(summary(recorded()), indent=1))


def current(row: Any, settings: list[Any], keep: bool) -> bool:
    """Whether a recorded row need not be made again."""
    return row is not None and row["settings"][: 3 if keep else 4] == settings[: 3 if keep else 4]


def recorded() -> dict[str, Any]:
    """The rows that there are."""
    return json.loads(TARGET.read_text())["models"] if TARGET.exists() else {}


def record(name: str, row: dict[str, Any]) -> dict[str, Any]:
    """Add a row, also while other parts run, and return the summary."""
    with (TARGET.parent / ".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = dict(sorted({**recorded(), name: row}.items()))
        result = {**describe(), "pooled": summary(done), "models": done}
        TARGET.write_text(json.dumps(result, indent=1, allow_nan=False))
    return result["pooled"]


if __name__ == "__main__":
    main()
