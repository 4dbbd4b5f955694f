"""The density of the sampler: is its integral 1 less what is rejected, and is it the draws' own?

int pdf by quadrature in coordinates that follow the lobe, plus the fraction of draws that are
rejected, is 1. At drawn directions pdf is the density of the draws: the sum of 1/|dw/du x dw/dv|
over all numbers that give the direction, in every lobe that u[2] may choose, times the lobe's
share (estimate.density); what it lacks of that, on average over draws, is a distance between draws
and pdf. A returned weight is f cos/pdf; where it is that on average alone, or where there is no
pdf, the mean weight of all draws with a direction is f cos over their density. Drawn directions
are finite unit vectors with pdf > 0, which is finite and not negative anywhere. All this also at
other azimuths and parameters, and at the ends of their ranges.
It cannot see: a pdf that is too large where its integral is right, but for what it then lacks
elsewhere; and the density of samplers in which all three numbers place a direction, or whose lobes'
shares depend on u[0] and u[1] (a note says so, and `sampling` asks).
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.survey import Survey, survey
from montecarlo_brdf.checks import _density, _draws, _mixture
from montecarlo_brdf.checks._draws import MASS_TOLERANCE
from montecarlo_brdf.checks._truth import RESOLVED
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.mixture import Nodes
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand, weighted
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.claim import (
    Claim,
    Exact,
    ExactClaim,
    Kind,
    Limit,
    MeanClaim,
    Reference,
    Skip,
)
from montecarlo_brdf.judge.decide import LEVEL
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.judge.mean import FRESH
from montecarlo_brdf.model import Property
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.statistics import Estimate, hidden_error

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

#: times the samples, for the rejected draws: an edge in the integrand, but a cheap one
EDGE = (4, 32)
MOST_REJECTED = 1 << 25  # of these draws

NAME = "pdf"
QUESTION = "does the pdf integrate to 1, is it the density of draws, is the weight f cos/pdf?"
PROPERTY = Property.PDF
#: standard errors in half of an interval that misses the truth once in 10^9, as a quadrature's does
SIGMAS = 6.1
SAMPLES = 1 << 21  # of the mass by uniform directions
#: of the draws: the share that pdf, or f, may lack; where a direction belongs to several numbers
TOLERANCE, OF_SEVERAL = 2e-3, 1e-2
GRAZING = 86.0  # degrees: beyond that samplers tend to have a way of their own
#: a law that a case and an angle are asked about
Evaluation = Callable[[Case], Exact]
Measure = Callable[[Case, float, Plan], list[Measurement]]


def claims(case: Case) -> Iterator[Claim]:
    """All claims about sample and pdf."""
    if case.model.sample is None:
        yield Skip("pdf", f"model {case.model.name} has no sampler")
        return
    yield _claim(case, "drawn directions at fault", 0.0, _draws.faults)
    if weighted(case.model):
        yield from _weights(case)
    if case.model.pdf is None:
        return
    yield _claim(case, "values of pdf at fault", 0.0, _draws.values)
    for theta in case.theta_o_deg:
        yield _normalisation(case, theta)
        yield _lacking(case, theta)
    at = survey(case)
    for k in _decidable(at):
        yield _normalisation(*at.place(k))
    yield _lacking(*at.place(_density.farthest(at)))
    if any(_density.averages(case, theta) for theta in (*case.theta_o_deg, GRAZING)):
        # what several numbers add up to is not seen by the draws' own alone
        ends = (*parameters.elsewhere(case), *parameters.at_extremes(case))
        yield _lacking(*_density.worst_of(ends))


def _weights(case: Case) -> Iterator[Claim]:
    """Where directions belong to several numbers a weight may be right on average alone: that is
    told, and asked; and it is what can be asked where there is no pdf."""
    places = [(case, theta) for theta in case.theta_o_deg]
    if case.model.pdf is not None:
        found = _draws.weight(case)
        right = found.value <= _draws.UNIT_TOLERANCE
        if right or not any(_density.averages(*place) for place in (*places, (case, GRAZING))):
            yield _claim(case, "|weight/(f cos/pdf) - 1|", _draws.UNIT_TOLERANCE, lambda _: found)
            return
        off = "not f cos/pdf draw by draw, as of one lobe of several: its mean is asked"
        value, points = found.value, found.points
        yield Limit("|weight/(f cos/pdf) - 1|", {}, value, points, "exact", note=off)
    for place in (*places, *parameters.elsewhere(case)):
        yield _overweight(*place)


def _lacking(case: Case, theta: float) -> Claim:
    """At a direction and parameters, pdf is the density of the draws."""
    return _of_draws(case, theta, "(1 - pdf/density)+", _density.lacking, _density.ratio_hint)


def _overweight(case: Case, theta: float) -> Claim:
    """The same of weights: their mean is f cos over that density."""
    quantity = "(1 - f cos/(density weight))+"
    return _of_draws(case, theta, quantity, _density.overweight, _density.weight_hint)


def _of_draws(
    case: Case, theta: float, quantity: str, measure: Measure, hint: Callable[[Case, float], str]
) -> Claim:
    """A share of the draws that is 0, where their density is known."""
    if why := _density.unknown(case, theta):
        return Skip(quantity, f"the density of the draws is not known: {why}; see `sampling`")
    return MeanClaim(
        quantity,
        parameters.where(case, theta),
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "sampler and density belong together"),
        OF_SEVERAL if _density.several(case, theta) else TOLERANCE,
        functools.partial(measure, case, theta),
        property=PROPERTY,
        diagnosis=functools.partial(hint, case, theta),
    )


def _decidable(at: Survey) -> set[int]:
    """The heaviest place whose density the quadrature resolves, and the worst of those that the
    mixture has nodes for, if it does there or says what refutes: elsewhere nothing would be said.
    """
    places = (k for k in _draws.heaviest(at) if _resolved(*at.place(k)))
    found = set(itertools.islice(places, 1))
    worst = _mixture.worst(at, at.mass - 1.0, _excess)
    return found | {worst} if _resolved(*at.place(worst)) else found


def _resolved(case: Case, theta: float) -> bool:
    """Whether the quadrature of pdf tells its mass, or that it is no density's: more than 1."""
    found = _draws.density_integral(case, theta)
    heavy = found.value - found.error > 1.0 + MASS_TOLERANCE
    return heavy or found.error <= RESOLVED * MASS_TOLERANCE


def _excess(nodes: Nodes) -> Array:
    return nodes.mass - 1.0


def _claim(case: Case, quantity: str, tolerance: float, evaluate: Evaluation) -> ExactClaim:
    return ExactClaim(
        quantity,
        {},
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "sampler and density belong together"),
        tolerance,
        functools.partial(evaluate, case),
        property=PROPERTY,
    )


def _normalisation(case: Case, theta: float) -> MeanClaim:
    return MeanClaim(
        "int pdf + rejected",
        parameters.where(case, theta),
        Bound.EQUAL,
        Reference(1.0, 0.0, Kind.LAW, "a density integrates to 1"),
        case.tolerated(MASS_TOLERANCE),
        functools.partial(_mass, case, theta),
        property=PROPERTY,
        diagnosis=functools.partial(_named, case, theta),
        fallback=functools.partial(_held, case, theta),
    )


def _named(case: Case, theta: float) -> str | None:
    return _density.ratio_cause(case, theta)


def _held(case: Case, theta: float, seed: int) -> Measurement:
    """The mass by uniform directions, where a density has more steps than the quadrature resolves.

    A lobe that they do not show hides in what the quadrature leaves open: they may hold the claim,
    not refute it.
    """
    plan = Plan(samples=SAMPLES, seed=seed)
    mean = integrand(case.model, Quantity.MASS, Sampler.UNIFORM)
    mass = estimates(case.model, case.one, case.wo(theta), [mean], plan, (NAME, "mass"))[0][0]
    rejected, integral = _rejected(case, theta, plan), _draws.density_integral(case, theta)
    whole = mass._replace(
        mean=mass.mean + rejected.mean, stderr=math.hypot(mass.stderr, rejected.stderr)
    )
    missed = abs(mass.mean - integral.value) > integral.error
    missed |= abs(whole.mean - 1.0) > case.tolerated(MASS_TOLERANCE)
    unfit = "a lobe that uniform directions may have missed" if missed else None
    return Measurement(Sampler.UNIFORM, whole, unfit)


def _rejected(case: Case, theta: float, plan: Plan) -> Estimate:
    lost = integrand(case.model, Quantity.REJECTED, Sampler.OWN)
    for times in EDGE:
        more = plan._replace(samples=max(plan.samples, min(times * plan.samples, MOST_REJECTED)))
        rows = estimates(case.model, case.one, case.wo(theta), [lost], more, (NAME,))
        if rows[0][0].half_width(LEVEL) < RESOLVED * case.tolerated(MASS_TOLERANCE):
            break
    return rows[0][0]


def _mass(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """int pdf by quadrature plus the rejected fraction by draws."""
    integral = _draws.density_integral(case, theta, plan.seed // FRESH)
    rejected = _rejected(case, theta, plan)
    unfit = None
    if not integral.error <= case.tolerated(MASS_TOLERANCE) + 1e-9:
        unfit = f"the quadrature of pdf resolves only {integral.error:.1e}"
    variance = rejected.second_moment - rejected.mean**2
    unseen = hidden_error(1.0, variance, rejected.samples)
    stderr = math.hypot(max(rejected.stderr, unseen), integral.error / SIGMAS)
    whole = rejected._replace(mean=rejected.mean + integral.value, stderr=stderr)
    return [Measurement("quadrature", whole, unfit)]
