"""The density of the sampler: does it integrate to 1 less what is rejected, and is it its Jacobian?

int pdf by quadrature in coordinates that follow the lobe, plus the fraction of draws that are
rejected, is 1; pdf |dw/du1 x dw/du2| by finite differences is 1 where one direction belongs to one
pair of numbers, and at least 1 where it belongs to several: what it lacks of 1, on average over u,
is a distance between draws and pdf. A returned weight is f cos/pdf; drawn directions are finite
unit vectors with pdf > 0, which is finite and not negative anywhere. All this also at other
azimuths and parameters, and at the ends of their ranges.
It cannot see: a density that is wrong in shape where the sampler chooses among lobes (`sampling`
can).
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.survey import Survey, sure, survey
from montecarlo_brdf.checks import _draws, _mixture
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
GRAZING = 86.0  # degrees: beyond that samplers tend to have a way of their own

NAME = "pdf"
QUESTION = "does the pdf integrate to 1, is it the sampler's Jacobian, is the weight f cos/pdf?"
PROPERTY = Property.PDF
#: standard errors in half of an interval that misses the truth once in 10^9, as a quadrature's does
SIGMAS = 6.1
SAMPLES = 1 << 21  # of the mass by uniform directions
#: of the draws: the share that pdf may lack
JACOBIAN_TOLERANCE = 2e-3
#: a law that a case and an angle are asked about
Evaluation = Callable[[Case], Exact]


def claims(case: Case) -> Iterator[Claim]:
    """All claims about sample and pdf."""
    if case.model.sample is None:
        yield Skip("pdf", f"model {case.model.name} has no sampler")
        return
    yield _claim(case, "drawn directions at fault", 0.0, _draws.faults)
    if case.model.pdf is None:
        return
    yield _claim(case, "values of pdf at fault", 0.0, _draws.values)
    chosen = any(_draws.chooses(case, theta) for theta in (*case.theta_o_deg, GRAZING))
    if weighted(case.model):
        yield _weights(case, chosen)
    for theta in case.theta_o_deg:
        yield _normalisation(case, theta)
        yield from _differences(case, theta)
    at = survey(case)
    for k in _decidable(at):
        yield _normalisation(*at.place(k))
    if not chosen:
        yield from _differences(*at.place(int(np.argmax(sure(_draws.deficits(at))))))


def _weights(case: Case, chosen: bool) -> Claim:
    """Where draws choose among lobes a weight may be right on average alone: that is told."""
    if chosen:
        found = _draws.weight(case)
        off = "not f cos/pdf draw by draw, as of one lobe of several: on average, see `cover`"
        note = off if found.value > _draws.UNIT_TOLERANCE else None
        quantity = "|weight/(f cos/pdf) - 1|"
        return Limit(quantity, {}, found.value, found.points, "exact", note=note)
    return _claim(case, "|weight/(f cos/pdf) - 1|", _draws.UNIT_TOLERANCE, _draws.weight)


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


def _differences(case: Case, theta: float) -> Iterator[Claim]:
    """What differences of neighbouring draws say."""
    if _draws.chooses(case, theta):
        yield Skip("pdf Jacobian", "the sampler chooses among lobes by u[2]: see `sampling`")
    else:
        yield _jacobian(case, theta)


def _jacobian(case: Case, theta: float) -> MeanClaim:
    return MeanClaim(
        "(1 - pdf Jacobian)+",
        parameters.where(case, theta),
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "sampler and density belong together"),
        JACOBIAN_TOLERANCE,
        functools.partial(_draws.deficit, case, theta),
        property=PROPERTY,
        diagnosis=functools.partial(_draws.ratio_hint, case, theta),
    )


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
    return None if _draws.chooses(case, theta) else _draws.ratio_cause(case, theta)


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
