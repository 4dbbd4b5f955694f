"""Do drawn directions follow the pdf?

Coordinates follow the lobe (half-vector slope and azimuth); the density in them, integrated by
quadrature, gives cells of equal probability; one cell more counts rejected draws. The verdict is
about the distance d = sqrt(chi2/N) of the two distributions: pass if it is surely below 1.5 %, fail
if chi2 rejects twice. It cannot see: differences within a cell; a density that is wrong by a
constant factor shows in `pdf`.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from montecarlo_brdf.cases import parameters
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _draws
from montecarlo_brdf.checks._cells import COARSE, FINE, FINEST, Cells
from montecarlo_brdf.estimate.cells import COLUMNS, ROWS
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
MOST = 3 << 19  # draws per look
WIDER = 2.0  # times the tolerance elsewhere
FEWER = 1 << 18  # samples elsewhere
SUSPICIOUS = 1e-3  # a p-value that makes grids finer
GROSS = 5.0  # times the tolerance: what no finer grid explains, its own error being taken off
Size = tuple[int, int]
Tables = Callable[[Size], Cells]
Measure = Callable[[Plan, float], Fit]
EXPECTED = 10.0  # draws in the cell of rejected ones, below which chi2 is none
SURPLUS = 40.0  # of them: so many above ten times what is expected have a probability < 1e-60
HEAVIEST = 1.02  # a mass that cells can stand


def claims(case: Case) -> Iterator[Claim]:
    """One per angle."""
    if case.model.sample is None or case.model.pdf is None:
        yield Skip("sampling", f"model {case.model.name} has no sampler with a pdf")
        return
    for theta in case.theta_o_deg:
        cells = tables(case, theta)
        if _hidden(cells(FINE)):
            reason = "a lobe of pdf lies where half vectors do not show it: `cover` asks about it"
            yield Skip(f"distance of draws from pdf at {theta:g} degrees", reason)
            continue
        yield FitClaim(
            "distance of draws from pdf",
            case.where(theta_o_deg=theta),
            case.tolerated(TOLERANCE),
            refined(case, theta, cells, case.tolerated(TOLERANCE), FINE, FINEST),
            property=PROPERTY,
        )
    # one lobe of several can be wrong where only all of them together tell
    ends = parameters.at_extremes(case) if _draws.chooses(case, case.theta_o_deg[0]) else ()
    for other, theta in (*parameters.elsewhere(case), *ends):
        cells = tables(other, theta)
        if 0.0 < cells(COARSE).tables[2] < HEAVIEST and not _hidden(cells(COARSE)):
            yield _elsewhere(other, theta, cells)  # else see `pdf` and `cover`


def _hidden(cells: Cells) -> bool:
    """Whether the pdf has more than cells show."""
    return 0.0 < cells.tables[2] < HEAVIEST and cells.lacking > GROSS * TOLERANCE


def _elsewhere(case: Case, theta: float, cells: Tables) -> FitClaim:
    """The same with fewer draws and a wider tolerance, at other azimuths and parameters."""
    tolerance = WIDER * case.tolerated(TOLERANCE)
    measure = refined(case, theta, cells, tolerance, COARSE, FINE, FINEST)
    return FitClaim(
        "distance of draws from pdf",
        parameters.where(case, theta),
        tolerance,
        lambda plan, level: measure(plan._replace(samples=min(plan.samples, FEWER)), level),
        property=PROPERTY,
    )


def tables(case: Case, theta: float) -> Tables:
    """Cells by the size of their grid, each made once."""
    return functools.cache(functools.partial(Cells, case, theta))


def refined(case: Case, theta: float, cells: Tables, tolerance: float, *sizes: Size) -> Measure:
    """A measurement on finer grids for as long as draws look wrong on coarser ones."""

    def measure(plan: Plan, level: float) -> Fit:
        for size in sizes:
            found = fit(case, theta, cells(size), plan, level)
            gross = found.p_value < level and found.distance > GROSS * tolerance
            if found.upper <= tolerance or found.p_value > SUSPICIOUS or gross:
                break
        return found

    return measure


def fit(case: Case, theta: float, cells: Cells, plan: Plan, level: float) -> Fit:
    """Draws counted in cells, against what pdf says of them."""
    mass = cells.tables[2]
    if not 0.0 < mass < HEAVIEST:
        return Fit(math.nan, math.inf, 1.0, 0, f"the pdf has mass {mass:.4g}: see `pdf`")
    n = min(math.ceil(DRAWS * plan.samples), case.budget(MOST))
    place = (theta, case.phi_o_deg, *case.one)
    key = stream(plan.seed, case.model.identity, NAME, *place, n)
    counts, expected = cells.counts(key, n, plan.threads), cells.probability
    shown = cells.shown(counts)
    if abs(counts[-1] / n - cells.rejected) <= cells.integral.error:  # a question for `pdf`
        counts[-1] = expected[-1] = 0.0
    found = judged(counts, expected, level)
    found = found._replace(hint=_hint(counts, expected), draws=shown)
    if found.p_value >= level:
        return found
    return found._replace(distance=max(0.0, found.distance - 2.0 * cells.error))


def _hint(counts: Array, expected: Array) -> str:
    """Where draws and pdf part: horizon, distance from the lobe's centre, azimuth."""
    cells = expected[0] * float(counts.sum())
    lost, due = counts[-1] / counts.sum(), expected[-1]
    if abs(lost - due) > 5.0 * math.sqrt(max(due, 1e-4) / counts.sum()) + 1e-3:
        return f"{lost:.3g} of the draws are rejected; pdf lacks {due:.3g} of its mass for them"
    table = counts[:-1].reshape(COLUMNS, ROWS) / cells
    around, outward = table.mean(axis=1), table.mean(axis=0)
    if np.ptp(around) > np.ptp(outward):
        k = int(np.argmax(np.abs(around - 1.0)))
        degrees = (k + 0.5) / COLUMNS * 360.0
        return f"azimuths about {degrees:.0f} degrees: {around[k]:.3g} of what pdf says"
    inner, outer = outward[0], outward[-1]
    kind = "wider" if inner < outer else "narrower"
    return f"draws are {kind} than pdf: {inner:.3g} of it at the centre, {outer:.3g} at the end"


def judged(counts: Array, probability: Array, level: float) -> Fit:
    """Distance, upper bound and p-value of counts; a last cell hardly expected is merged.

    chi2 of draws at distance d is noncentral with parameter N d^2: the upper bound is the distance
    under which so small a chi2 has probability `level`.
    """
    from scipy.special import chdtrc, chndtrinc

    n = float(counts.sum())
    if probability[-1] * n < EXPECTED:
        if counts[-1] > SURPLUS + 10.0 * probability[-1] * n:
            return Fit(math.sqrt(counts[-1] / n), math.inf, 0.0, int(n))
        counts, probability = counts[:-1], probability[:-1] / probability[:-1].sum()
    used = float(counts.sum())
    chi2 = float(np.sum((counts - used * probability) ** 2 / (used * probability)))
    dof = len(counts) - 1
    excess = max(chi2 - dof, 0.0)
    upper = math.sqrt(float(chndtrinc(max(chi2, dof), dof, level)) / used)
    return Fit(math.sqrt(excess / used), upper, float(chdtrc(dof, chi2)), int(n))
