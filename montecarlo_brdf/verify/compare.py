"""Two models side by side: their values, their albedo A and their reverse albedo R."""
from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from typing import Any

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import equality
from montecarlo_brdf.checks._truth import quadrature
from montecarlo_brdf.estimate.arguments import check_theta
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Claim, Exact, ExactClaim, Reference
from montecarlo_brdf.judge.decide import decide
from montecarlo_brdf.judge.finding import Report, Result
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.report.sentences import called
from montecarlo_brdf.vectors import from_degrees
from montecarlo_brdf.verify.common import (
    Progress,
    check_tolerance,
    reported,
    shared_progress,
    shown_parameters,
)
from montecarlo_brdf.verify.furnace import ANGLES
from montecarlo_brdf.verify.subject import probed, source


def compare(
    model: Model,
    other: Model,
    cases: Sequence[tuple[Any, Any]] | None = None,
    theta_o_deg: Sequence[float] = ANGLES,
    *,
    phi_o_deg: float = 0.0,
    tolerance: float | None = None,
    seed: int = 0,
    progress: Progress | None = None,
) -> Report:
    """Whether two models agree: f within 1e-6 of its value over thousands of pairs of directions,
    A(wo) and R(wi), by quadrature with error bounds, within 1e-4 (or all within `tolerance`).

    cases: pairs of parameter sets, one of each model; None for the defaults of both.
    """
    angles = [check_theta(a) for a in theta_o_deg]
    check_tolerance(tolerance)
    started = time.perf_counter()
    results = []
    cases = cases or [(model.parameters(), other.parameters())]
    for k, (p, q) in enumerate(cases):
        variant, other_variant = model.of(p), other.of(q)
        probed(variant, p)
        probed(other_variant, q)
        case = Case(variant, p, angles, phi_o_deg, tolerance=tolerance, seed=seed)
        share = shared_progress(progress, k, len(cases))
        findings = [decide(c, Plan(seed=seed), None) for c in _told(case, other_variant, q, share)]
        title = f"against {called(other.name, shown_parameters(other_variant, q))}"
        shown = shown_parameters(variant, p)
        results.append(Result(model.name, shown, title, findings, source=source(variant)))
    settings = {"theta_o_deg": angles, "phi_o_deg": phi_o_deg, "tolerance": tolerance, "seed": seed}
    return reported("compare", settings, results, started)


def _told(case: Case, other: Model, q: Any, progress: Progress | None) -> Iterator[Claim]:
    """The claims, with the progress of deciding them."""
    found = list(_claims(case, other, q))
    for k, claim in enumerate(found):
        yield claim
        if progress:
            progress((k + 1) / len(found))


def _claims(case: Case, other: Model, q: Any) -> Iterator[Claim]:
    pairs = list(zip(case.sets, channels(q), strict=False))
    for k, (one, two) in enumerate(pairs):
        channel = {"channel": k} if len(pairs) > 1 else {}
        yield _values(case, other, one, two, channel)
        for theta in case.theta_o_deg:
            for symbol, reverse in (("A", False), ("R", True)):
                yield _albedo(case, other, (one, two), theta, symbol, reverse, channel)


def _values(case: Case, other: Model, one: Any, two: Any, channel: dict[str, Any]) -> Claim:
    return ExactClaim(
        "|f - other f|/f",
        channel,
        "at most",
        Reference(0.0, 0.0, "other model", other.name),
        case.tolerated(equality.TOLERANCE),
        lambda: equality.difference(case, one, other, two, case.random("compare")),
    )


def _albedo(
    case: Case,
    other: Model,
    pair: tuple[Any, Any],
    theta: float,
    symbol: str,
    reverse: bool,
    channel: dict[str, Any],
) -> Claim:
    fixed = from_degrees(theta, case.phi_o_deg)
    expected = Reference(*quadrature(other, pair[1], fixed, reverse), "other model", other.name)
    return ExactClaim(
        symbol,
        case.where(**{f"theta_{'i' if reverse else 'o'}_deg": theta}, **channel),
        "equal",
        expected,
        case.tolerated(AGREEMENT_TOLERANCE) * abs(expected.value),
        lambda: Exact(*quadrature(case.model, pair[0], fixed, reverse)),
    )
