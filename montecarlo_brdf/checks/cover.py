"""Does the sampler draw all that f reflects, and as often as it says?

A sampler that never draws a part of f is unbiased for the rest alone, and its error bar says
nothing. What is reflected where f cos is more than a thousand times what pdf accounts for is
measured by a mixture of densities that does draw it (estimate.mixture). And draws are held against
the measures themselves: means of cosines, steps and harmonics of the azimuth over draws equal
integrals of pdf times these, and over weighted draws those of f cos. So a weight without a pdf is
judged too, and one that is right on average alone, as of one lobe out of several, is right. Both at
the worst of the places that all laws are asked at (cases.survey).
It cannot see: what harmonics of the azimuth beyond the eighth, and polar angles within the same
fifth of the cosine, average out.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.cases.survey import Survey, hardly, sure, survey
from montecarlo_brdf.checks import _mixture
from montecarlo_brdf.checks._moments import Moment, differences, measured, resolvable
from montecarlo_brdf.estimate.samplers import weighted
from montecarlo_brdf.judge.claim import Claim, Kind, MeanClaim, Reference, Skip
from montecarlo_brdf.judge.finding import Bound
from montecarlo_brdf.model import Property

if TYPE_CHECKING:
    pass

NAME = "cover"
QUESTION = "does the sampler draw all that f reflects?"
PROPERTY = Property.PDF
CANDIDATES = 12  # that are looked at for one that draws can decide
TOLERANCE = 1e-2  # of light: what the sampler may leave out, and by how much a mean may be off


def claims(case: Case) -> Iterator[Claim]:
    """What is hardly drawn, and the mean that is farthest off, of draws and of their weights."""
    if case.model.sample is None or not (case.model.pdf or weighted(case.model)):
        yield Skip("cover", f"model {case.model.name} has no sampler with a pdf or a weight")
        return
    at = survey(case)
    if case.model.pdf is not None:
        yield _undrawn(*at.place(_mixture.worst(at, at.undrawn, hardly)))
    for moment, k in _worst_moments(at):
        yield _off(*at.place(k), moment)


def _undrawn(case: Case, theta: float) -> Claim:
    return MeanClaim(
        "reflected, but hardly drawn",
        parameters.where(case, theta),
        Bound.AT_MOST,
        Reference(0.0, 0.0, Kind.LAW, "pdf > 0 where f > 0"),
        case.tolerated(TOLERANCE),
        functools.partial(_mixture.undrawn, case, theta),
        property=PROPERTY,
        cause=lambda: "where f is large, pdf is less than a thousandth of it: a lobe is not drawn",
    )


def _worst_moments(at: Survey) -> Iterator[tuple[Moment, int]]:
    """The moment and the place that are farthest off, of draws and of weighted draws."""
    for kind, off in differences(at).items():
        rows = np.array([sure(off[:, :, m]) for m in range(off.shape[2])])
        for flat in np.argsort(-rows, axis=None)[:CANDIDATES]:
            m, k = np.unravel_index(int(flat), rows.shape)
            moment, place = Moment(kind, int(m)), int(at.some[k])
            if resolvable(*at.place(place), moment, TOLERANCE):
                yield moment, place
                break


def _off(case: Case, theta: float, moment: Moment) -> Claim:
    return MeanClaim(
        moment.text,
        parameters.where(case, theta),
        Bound.EQUAL,
        Reference(0.0, 0.0, Kind.LAW, "draws follow what they say"),
        case.tolerated(TOLERANCE),
        functools.partial(measured, case, theta, moment),
        property=PROPERTY,
        cause=lambda: "the draws' distribution is another one: look at how directions are drawn",
    )
