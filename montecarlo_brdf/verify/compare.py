"""Two models side by side: their values, their albedo A and their reverse albedo R."""
from __future__ import annotations

import functools
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from montecarlo_brdf.cases.case import Case, search_range, searched
from montecarlo_brdf.checks import equality
from montecarlo_brdf.checks._truth import confirmed
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.plan import Progress, check_theta
from montecarlo_brdf.estimate.probe import number_from
from montecarlo_brdf.judge.claim import AGREEMENT_TOLERANCE, Exact, ExactClaim, Kind, Reference
from montecarlo_brdf.judge.finding import Bound, Command, Report
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
    tolerance: float | None = None, declared: float | None = None, seed: int = 0,
    progress: Progress | None = None,
) -> Report:  # fmt: skip
    """Whether two models agree: f over thousands of pairs of directions, A(wo) and R(wi) by
    quadrature with error bounds.

    model, other: from `load`, or the second from `counterpart`. cases: pairs of parameter sets, one
    of each model; None for the first's defaults, where f is also searched over the ranges of the
    parameters that both know. theta_o_deg, phi_o_deg: polar angles in [0, 90) and azimuth, in
    degrees, of the direction that is given. tolerance: relative, in [0, 1); None for 1e-6 of f and
    1e-4 of A and R. declared: compare nothing but the first model's own `albedo()`, a fit or a
    table, with the other's A, to this absolute tolerance. seed: of the random pairs, 0 to 2^64 - 1.
    progress: is called with the fraction done.

    Returns a Report with one Result per pair. Raises UserError for a bad value, ModelError if a
    model does not run, TooSlow if it does not return.
    """
    angles = [check_theta(a) for a in theta_o_deg]
    settings = Settings.of(seed=seed, tolerance=tolerance)
    if declared is not None and not (model.albedo and 0.0 < declared < math.inf):
        what = f"model {model.name} declares no albedo(cos_theta_o, p)"
        bad = f"a declared albedo needs a tolerance above 0, not {declared:g}"
        raise UserError(bad if model.albedo else what)
    free = () if cases else common(model, other)
    questions = []
    usual = model.parameters()
    pairs = cases or [(usual, equality.shared(other, usual))]
    for p, q in pairs:
        second = other.of(q)
        probed(second, q)
        title = f"against {called(other.name, shown_parameters(second, q))}"
        title += f", f for all {', '.join(free)}" if free and declared is None else ""
        asked = narrowed(model.of(p), second, free)
        case = Case(asked, p, angles, phi_o_deg, tolerance=tolerance, free=free, seed=seed)
        claimed = claims if declared is None else functools.partial(fits, tolerance=declared)
        questions.append(Question(title, case, functools.partial(claimed, other=second, q=q)))
    told = {"theta_o_deg": angles, "phi_o_deg": phi_o_deg, "tolerance": tolerance, "seed": seed}
    count = 1 + 2 * len(angles)
    with failure.located(other, lambda: [q for _, q in pairs], angles):
        return answered(Command.COMPARE, told, questions, settings.plan, count, progress)


def common(model: Model, other: Model) -> tuple[str, ...]:
    """Parameters that both know with a range that they share."""
    both = set(searched(model, {})) & set(searched(other, {}))
    return tuple(n for n in model.Params._fields if n in both and _ends(model, other, n))


def narrowed(model: Model, other: Model, free: Sequence[str]) -> Model:
    """The model within the ranges that both have."""
    if not free:
        return model
    ends = {n: _ends(model, other, n) or (0.0, 0.0) for n in free}
    return replace(model, domain={**model.domain, **ends}, verified=())


def _ends(model: Model, other: Model, name: str) -> tuple[float, float] | None:
    ours, theirs = search_range(model, name), search_range(other, name)
    if not ours or not theirs:
        return None
    low, high = max(ours[0], theirs[0]), min(ours[1], theirs[1])
    return (low, high) if low < high else None


def fits(case: Case, other: Model, q: NamedTuple, tolerance: float) -> Iterator[ExactClaim]:
    """The declared albedo is the other's A."""
    for theta in case.theta_o_deg:
        wo = from_degrees(theta, case.phi_o_deg)
        value, error = confirmed(other, channels(q)[0], wo)
        yield ExactClaim(
            "albedo()", case.where(theta_o_deg=theta), Bound.EQUAL,
            Reference(value, error, Kind.OTHER_MODEL, f"A of {other.name}"), tolerance,
            functools.partial(_declared, case, wo[2]),
        )  # fmt: skip


def _declared(case: Case, mu: float) -> Exact:
    return Exact(number_from(case.model, "albedo", case.model.albedo, mu, case.one))  # type: ignore[arg-type]


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
                equality.difference, case._replace(p=one), other, q=None if case.free else two
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
    value, error = confirmed(other, pair[1], fixed, reverse)
    place = {f"theta_{'i' if reverse else 'o'}_deg": theta, **channel}
    return ExactClaim(
        "R" if reverse else "A", case.where(**place), Bound.EQUAL,
        Reference(value, error, Kind.OTHER_MODEL, other.name),
        case.tolerated(AGREEMENT_TOLERANCE) * abs(value),
        lambda: Exact(*confirmed(case.model, pair[0], fixed, reverse)),
    )  # fmt: skip
