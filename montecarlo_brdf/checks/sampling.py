"""Do drawn directions follow the pdf?

Draws are counted in groups of cells of about equal probability, by the quadrature that finds the
density's peaks; one more counts rejected draws. The verdict is about the distance d = sqrt(chi2/N)
of the two distributions: pass if it is surely below 1.5 %, fail if chi2 rejects twice. It
cannot see: differences within a group; a density that is wrong by a constant factor shows in `pdf`.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _density
from montecarlo_brdf.checks._cells import Cells
from montecarlo_brdf.chi_squared import largest_excess, upper_tail
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.judge.claim import Claim, Fit, FitClaim, Skip
from montecarlo_brdf.model import Property
from montecarlo_brdf.sampling.points import stream

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array

NAME = "sampling"
QUESTION = "do drawn directions follow pdf?"
PROPERTY = Property.PDF
TOLERANCE = 0.015
DRAWS = 1.5  # per sample allowed: with 2^20 draws honest ones of two standard deviations stay open
MOST = 3 << 19  # draws of a look, of which effort takes a share
WIDER = 2.0  # times the tolerance elsewhere
FEWER = 4  # times fewer draws elsewhere
EXPECTED = 10.0  # draws in the cell of rejected ones, below which chi2 is none
SURPLUS = 40.0  # of them: so many above ten times what is expected have a probability < 1e-60
KNOWN = 0.5  # of a tolerance: what the cells' own error may take of it to judge by
HEAVIEST = 1.02  # a mass that cells can stand


def claims(case: Case) -> Iterator[Claim]:
    """One per angle, and some at other azimuths and parameters."""
    if case.model.sample is None or case.model.pdf is None:
        yield Skip("sampling", f"model {case.model.name} has no sampler with a pdf")
        return
    for theta in case.theta_o_deg:
        tolerance = case.tolerated(TOLERANCE)
        cells = Cells(case, theta, tolerance)
        if _usable(cells) and not _resolved(cells, tolerance):
            reason = f"the quadrature of pdf resolves only {cells.error:.1e}: `cover` holds draws"
            yield Skip(f"distance of draws from pdf at {theta:g} degrees", reason)
            continue
        measure = functools.partial(fit, case, theta, cells)
        yield _claim(case.where(theta_o_deg=theta), tolerance, measure)
    # where no direction's density is known, one lobe of several can be wrong at the ends of ranges
    ends = parameters.at_extremes(case) if _density.unknown(case, case.theta_o_deg[0]) else ()
    for other, theta in (*parameters.elsewhere(case), *ends):
        tolerance = WIDER * case.tolerated(TOLERANCE)
        cells = Cells(other, theta, tolerance)
        if _usable(cells) and _resolved(cells, tolerance):  # else see `pdf` and `cover`
            measure = functools.partial(_fewer, other, theta, cells)
            yield _claim(parameters.where(other, theta), tolerance, measure)


def _usable(cells: Cells) -> bool:
    """Whether the mass is about that of a density: `pdf` asks about it."""
    return 0.0 < cells.mass < HEAVIEST


def _resolved(cells: Cells, tolerance: float) -> bool:
    """Whether the cells' probabilities are known well enough to judge by."""
    return cells.error <= KNOWN * tolerance


def _claim(
    where: Mapping[str, Any], tolerance: float, measure: Callable[[Plan, float], Fit]
) -> FitClaim:
    return FitClaim("distance of draws from pdf", where, tolerance, measure, property=PROPERTY)


def _fewer(case: Case, theta: float, cells: Cells, plan: Plan, level: float) -> Fit:
    """The same with fewer draws."""
    return fit(case, theta, cells, plan._replace(samples=-(-plan.samples // FEWER)), level)


def fit(case: Case, theta: float, cells: Cells, plan: Plan, level: float) -> Fit:
    """Draws counted in cells, against what pdf says of them; what is not known of the cells is
    taken off the distance, and added to its upper bound."""
    if not _usable(cells):
        return Fit(math.nan, math.inf, 1.0, 0, f"the pdf has mass {cells.mass:.4g}: see `pdf`")
    wanted = math.ceil(DRAWS * plan.samples)
    n = min(wanted, case.budget(max(MOST, wanted)))
    place = (theta, case.phi_o_deg, *case.one)
    key = stream(plan.seed, case.model.identity, NAME, *place, n)
    counts, expected = cells.counts(key, n, plan.threads), cells.probability.copy()
    shown = cells.shown(counts)
    if abs(counts[-1] / n - expected[-1]) <= cells.parts.error:  # a question for `pdf`
        counts[-1] = expected[-1] = 0.0
    found = judged(counts, expected, level)
    distance = max(0.0, found.distance - cells.error)
    hint = _hint(cells, counts, expected)
    upper = found.upper + cells.error
    return found._replace(distance=distance, upper=upper, hint=hint, draws=shown)


def _hint(cells: Cells, counts: Array, expected: Array) -> str:
    """Where draws and pdf part: at the horizon, or in which directions."""
    n = float(counts.sum())
    lost, due = counts[-1] / n, expected[-1]
    if abs(lost - due) > 5.0 * math.sqrt(max(due, 1e-4) / n) + 1e-3:
        return f"{lost:.3g} of the draws are rejected; pdf lacks {due:.3g} of its mass for them"
    usual = n * expected[:-1]
    k = int(np.argmax((counts[:-1] - usual) ** 2 / usual))
    theta, phi = cells.about(k)
    place = f"wi about {theta:.0f} degrees, azimuth {phi:.0f}"
    return f"{place}: {counts[k] / usual[k]:.3g} of the draws that pdf says"


def judged(counts: Array, probability: Array, level: float) -> Fit:
    """Distance, upper bound and p-value of counts; a last cell hardly expected is merged.

    chi2 of draws at distance d is noncentral with parameter N d^2: the upper bound is the distance
    under which so small a chi2 has probability `level`.
    """
    n = float(counts.sum())
    if probability[-1] * n < EXPECTED:
        if counts[-1] > SURPLUS + 10.0 * probability[-1] * n:
            return Fit(math.sqrt(counts[-1] / n), math.inf, 0.0, int(n))
        counts, probability = counts[:-1], probability[:-1] / probability[:-1].sum()
    used = float(counts.sum())
    chi2 = float(np.sum((counts - used * probability) ** 2 / (used * probability)))
    dof = len(counts) - 1
    excess = max(chi2 - dof, 0.0)
    upper = math.sqrt(largest_excess(max(chi2, dof), dof, level) / used)
    return Fit(math.sqrt(excess / used), upper, upper_tail(chi2, dof), int(n))
