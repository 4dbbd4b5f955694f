"""Measurements by a mixture of densities that no lobe escapes, and where they look worst.

The mixture knows nothing of the model but its f, and of its pdf what that says: energy is refuted
by it and never by draws of a sampler that may contradict its own pdf.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases.case import Case, Parameters
from montecarlo_brdf.cases.survey import Law, Survey, hardly, reflected_of, sure
from montecarlo_brdf.estimate.mixture import Groups, centres, estimated, taken
from montecarlo_brdf.estimate.places import rows_of
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.trust import Measurement, look, moment_is_finite
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.sampling.points import stream
from montecarlo_brdf.vectors import Vec

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "mixture"
QUICK, MOST = 1 << 17, 1 << 19  # nodes of an estimate, and of one that looks like refuting
DOUBTED = 2.0  # standard errors from which on it does
#: nodes of the places that look worst, and how many of them are looked at so
STAGES = ((2048, 24), (1 << 14, 4))
LIKELY = 8  # places of the first stage by their mean, whatever its error
CHOOSING = 16  # replicates

def worst(
    at: Survey, first: Array, law: Law, own: bool = True, due: Array | float = 0.0
) -> int:
    """The place that is farthest from what is due, for places (n, 1) or all; first: the law's
    numbers (n, replicates) by a survey's own nodes."""
    due = np.broadcast_to(due, (len(first), 1))
    index = np.unique(np.concatenate([
        np.argsort(-sure(first - due), kind="stable")[: STAGES[0][1]],
        np.argsort(-np.abs((first - due).mean(axis=1)), kind="stable")[:LIKELY],
    ]))  # fmt: skip
    for size, many in STAGES:
        index = index[:many] if size == STAGES[-1][0] else index
        again = at.taken(index, at.case.budget(size, 256), CHOOSING, law, own=own)
        index = index[np.argsort(-sure(again - due[index]), kind="stable")]
    return int(index[0])


def albedo(case: Case, theta: float, plan: Plan) -> Measurement:
    """A(wo), by nodes that know nothing of the sampler."""
    return reflected(case.model, case.one, case.wo(theta), plan)


def reflected(
    model: Model, one: Parameters, fixed: Vec, plan: Plan, reverse: bool = False
) -> Measurement:
    """A(wo) or, reversed, R(wi)."""
    exponent = look(model, one, fixed).exponent
    unfit = None
    if not moment_is_finite(4, Sampler.COSINE, exponent):
        unfit = f"f grows like mu^-{exponent:.2f}: its error bar can not be trusted"
    how = {"own": False, "reverse": reverse}
    quick = plan._replace(samples=min(plan.samples, QUICK))
    found = _estimated(model, one, fixed, quick, reflected_of, **how)
    if found.estimate.mean - DOUBTED * found.estimate.stderr > 1.0:  # the rest is for a refutation
        found = _estimated(model, one, fixed, plan, reflected_of, **how)
    return found._replace(unfit=unfit)


def undrawn(case: Case, theta: float, plan: Plan) -> list[Measurement]:
    """How much is reflected where f cos is far more than pdf accounts for."""
    return [_estimated(case.model, case.one, case.wo(theta), plan, hardly)]


def _estimated(
    model: Model, one: Parameters, fixed: Vec, plan: Plan, law: Law, own: bool = True,
    reverse: bool = False,
) -> Measurement:  # fmt: skip
    """A law's number at one place."""
    sized = min(plan.samples, MOST), plan.replicates, plan.seed
    return _measured(model, one, fixed, sized, law, own, reverse)


@functools.lru_cache(maxsize=64)
def _measured(
    model: Model, one: Parameters, fixed: Vec, sized: tuple[int, int, int], law: Law, own: bool,
    reverse: bool,
) -> Measurement:  # fmt: skip
    size, replicates, seed = sized
    sets = rows_of(model, one, np.array([tuple(one)], dtype=float).reshape(1, -1))
    at = Groups(sets, np.array([fixed]))
    place = model.identity, *model.picks.values(), *one, *fixed, size
    key = stream(seed, NAME, law.__name__, *place)
    how = {"own": own, "reverse": reverse}
    means = taken(model, at, centres(model, at, reverse), size, replicates, key, law, **how)
    return Measurement(NAME, estimated(means[0], size))
