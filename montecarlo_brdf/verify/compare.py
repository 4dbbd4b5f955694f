"""Two models side by side: their values, their albedo A and their reverse albedo R."""
from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import equality
from montecarlo_brdf.checks._truth import quadrature
from montecarlo_brdf.estimate.plan import Progress, check_theta
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Exact, ExactClaim, Kind, Reference
from montecarlo_brdf.judge.finding import Bound, Report
from montecarlo_brdf.model import Model, channels
from montecarlo_brdf.report.text import called
from montecarlo_brdf.vectors import from_degrees
from montecarlo_brdf.verify import failure
from montecarlo_brdf.verify.furnace import ANGLES
from montecarlo_brdf.verify.question import (
    Question,
    Settings,
    answered,
    probed,
    shown_parameters,
)


def compare(
    model: Model, other: Model, cases: Sequence[tuple[Any, Any]] | None = None,
    theta_o_deg: Sequence[float] = ANGLES, *, phi_o_deg: float = 0.0,
    tolerance: float | None = None, seed: int = 0, progress: Progress | None = None,
) -> Report:  # fmt: skip
    """Whether two models agree: f over thousands of pairs of directions, A(wo) and R(wi) by
    quadrature with error bounds.

    model, other: from `load`. cases: pairs of parameter sets, one of each model; None for the
    defaults of both. theta_o_deg, phi_o_deg: polar angles in [0, 90) and azimuth, in degrees, of
    the direction that is given. tolerance: relative, in [0, 1); None for 1e-6 of f and 1e-4 of A
    and R. seed: of the random pairs, 0 to 2^64 - 1. progress: is called with the fraction done.

    Returns a Report with one Result per pair. Raises UserError for a bad value, ModelError if a
    model does not run, TooSlow if it does not return.
    """
    angles = [check_theta(a) for a in theta_o_deg]
    settings = Settings(seed=seed, tolerance=tolerance)
    questions = []
    for p, q in cases or [(model.parameters(), other.parameters())]:
        second = other.of(q)
        probed(second, q)
        title = f"against {called(other.name, shown_parameters(second, q))}"
        case = Case(model.of(p), p, angles, phi_o_deg, tolerance=tolerance, seed=seed)
        questions.append(Question(title, case, functools.partial(claims, other=second, q=q)))
    told = {"theta_o_deg": angles, "phi_o_deg": phi_o_deg, "tolerance": tolerance, "seed": seed}
    count = 1 + 2 * len(angles)
    theirs = [q for _, q in cases or ()] or [other.parameters()]
    with failure.located(other, lambda: theirs, angles):
        return answered("compare", told, questions, settings.plan, count, progress)


def claims(case: Case, other: Model, q: NamedTuple) -> Iterator[ExactClaim]:
    """Equal values, A and R, per channel."""
    pairs = list(zip(case.sets, channels(q), strict=False))
    for k, (one, two) in enumerate(pairs):
        channel = {"channel": k} if len(pairs) > 1 else {}
        yield ExactClaim(
            "|f - other f|/f",
            channel,
            Bound.AT_MOST,
            Reference(0.0, 0.0, Kind.OTHER_MODEL, other.name),
            case.tolerated(equality.TOLERANCE),
            functools.partial(
                equality.difference, case, one, other, two, case.random("compare")
            ),
        )
        for theta in case.theta_o_deg:
            for reverse in (False, True):
                yield _albedo(case, other, (one, two), theta, reverse, channel)


def _albedo(
    case: Case, other: Model, pair: tuple[Any, Any], theta: float, reverse: bool,
    channel: dict[str, int],
) -> ExactClaim:  # fmt: skip
    fixed = from_degrees(theta, case.phi_o_deg)
    value, error = quadrature(other, pair[1], fixed, reverse)
    place = {f"theta_{'i' if reverse else 'o'}_deg": theta, **channel}
    return ExactClaim(
        "R" if reverse else "A", case.where(**place), Bound.EQUAL,
        Reference(value, error, Kind.OTHER_MODEL, other.name),
        case.tolerated(AGREEMENT_TOLERANCE) * abs(value),
        lambda: Exact(*quadrature(case.model, pair[0], fixed, reverse)),
    )  # fmt: skip
