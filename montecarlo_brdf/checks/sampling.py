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
from collections.abc import Iterator
from typing import Any

import numpy as np

from montecarlo_brdf.checks import interiors
from montecarlo_brdf.checks.case import Case, pointwise
from montecarlo_brdf.checks.claim import Claim, Fit, FitClaim, Skip
from montecarlo_brdf.checks.lobe_coordinates import Coordinates
from montecarlo_brdf.checks.truth import lobe_scale
from montecarlo_brdf.integration.estimators import Plan
from montecarlo_brdf.sampling.streams import stream

NAME = "sampling"
QUESTION = "do drawn directions follow pdf?"
PROPERTY = "pdf"
TOLERANCE = 0.015
ROWS, COLUMNS = 12, 16
FINE = (768, 512)  # the grid on which the density is tabulated
COARSE = (384, 256)
MOST = 1 << 20  # draws per look
FEWER = 1 << 18  # elsewhere
HEAVIEST = 1.02  # a mass that cells can stand


def claims(case: Case) -> Iterator[Claim]:
    """One per angle."""
    if case.model.sample is None or case.model.pdf is None:
        yield Skip("sampling", f"model {case.model.name} has no sampler with a pdf")
        return
    for theta in case.theta_o_deg:
        yield FitClaim(
            "distance of draws from pdf",
            case.where(theta_o_deg=theta),
            case.tolerated(TOLERANCE),
            functools.partial(_fit, case, theta, Cells(case, theta)),
            property=PROPERTY,
        )
    for other, theta in interiors.elsewhere(case):
        cells = Cells(other, theta, COARSE)
        if 0.0 < cells.tables[2] < HEAVIEST:  # else see `pdf`
            yield _elsewhere(other, theta, cells)


def _elsewhere(case: Case, theta: float, cells: Cells) -> FitClaim:
    """The same with fewer draws and a wider tolerance, at other azimuths and parameters."""

    def measure(plan: Plan, level: float) -> Fit:
        return _fit(case, theta, cells, plan._replace(samples=min(plan.samples, FEWER)), level)

    return FitClaim(
        "distance of draws from pdf",
        {**case.where(theta_o_deg=theta), **interiors.changed(case, case.one)},
        2.0 * case.tolerated(TOLERANCE),
        measure,
        property=PROPERTY,
    )


class Cells:
    """Cells of equal probability under the pdf, from its marginal and conditional distributions."""

    def __init__(self, case: Case, theta: float, size: tuple[int, int] = FINE) -> None:
        self.size = size
        self.wo = np.array(case.wo(theta))
        self.functions = pointwise(case.model, case.one)
        self.coordinates = Coordinates(self.wo, lobe_scale(case.model, case.one, self.wo))

    @functools.cached_property
    def tables(self) -> tuple[Any, Any, float]:
        """(cumulated marginal in b, cumulated conditionals in x, total mass), midpoint rule."""
        nx, nb = self.size
        x, b = (np.arange(nx) + 0.5) / nx, (np.arange(nb) + 0.5) / nb
        xx, bb = np.meshgrid(x, b, indexing="ij")
        wi, jacobian = self.coordinates.directions(xx.ravel(), bb.ravel())
        density = (jacobian * self.functions.pdf(self.wo, wi)).reshape(nx, nb) / (nx * nb)
        columns = np.concatenate([np.zeros((1, nb)), np.cumsum(density, axis=0)])
        marginal = np.concatenate([[0.0], np.cumsum(columns[-1])])
        return marginal, columns, float(marginal[-1])

    @functools.cached_property
    def error(self) -> float:
        """Distance between the cells' probabilities and those by another grid, at random in each
        square: what a density with steps leaves unresolved."""
        nx, nb = self.size
        jitter = np.random.default_rng(0).random((2, nx, nb))
        x = (np.arange(nx)[:, None] + jitter[0]) / nx
        b = (np.arange(nb)[None, :] + jitter[1]) / nb
        wi, jacobian = self.coordinates.directions(x.ravel(), b.ravel())
        density = jacobian * self.functions.pdf(self.wo, wi) / (nx * nb)
        found = np.bincount(self.index(wi), weights=density, minlength=ROWS * COLUMNS)
        each = self.tables[2] / (ROWS * COLUMNS)
        return float(np.sqrt(np.sum((found - each) ** 2 / each)))

    def index(self, w: Any) -> Any:
        """The cell of each direction above the horizon: equal probability under pdf/mass."""
        marginal, columns, mass = self.tables
        nx, nb = self.size
        x, b = self.coordinates.coordinates(w)
        row, column = x * nx, b * nb
        k = np.minimum(column.astype(int), nb - 1)
        share = marginal[k] + (column - k) * (marginal[k + 1] - marginal[k])
        j = np.minimum(row.astype(int), nx - 1)
        height = columns[j, k] + (row - j) * (columns[j + 1, k] - columns[j, k])
        inside = height / np.maximum(columns[-1, k], 1e-300)
        return _cell(share / mass, COLUMNS) * ROWS + _cell(inside, ROWS)


def _cell(share: Any, n: int) -> Any:
    return np.clip((share * n).astype(int), 0, n - 1)


def _fit(case: Case, theta: float, cells: Cells, plan: Plan, level: float) -> Fit:
    mass = cells.tables[2]
    if not 0.0 < mass < HEAVIEST:
        return Fit(math.nan, math.inf, 1.0, 0, f"the pdf has mass {mass:.4g}: see `pdf`")
    n = min(plan.samples, MOST)
    rng = np.random.default_rng(stream(plan.seed, case.model.name, NAME, theta, n))
    counts = np.zeros(ROWS * COLUMNS + 1)
    for start in range(0, n, 1 << 16):
        w, _ = cells.functions.sample(cells.wo, rng.random((min(1 << 16, n - start), 3)))
        above = np.isfinite(w).all(axis=1) & (w[:, 2] > 0.0)
        counts[:-1] += np.bincount(cells.index(w[above]), minlength=ROWS * COLUMNS)
        counts[-1] += np.count_nonzero(~above)
    expected = np.full(counts.shape, mass / (ROWS * COLUMNS))
    expected[-1] = max(1.0 - mass, 0.0)
    found = judged(counts, expected, level)._replace(hint=_hint(counts, expected))
    if found.p_value >= level:
        return found
    return found._replace(distance=max(0.0, found.distance - 2.0 * cells.error))


def _hint(counts: Any, expected: Any) -> str:
    """Where draws and pdf part: horizon, distance from the lobe's centre, azimuth."""
    cells = expected[0] * float(counts.sum())
    lost, due = counts[-1] / counts.sum(), expected[-1]
    if abs(lost - due) > 5.0 * math.sqrt(max(due, 1e-4) / counts.sum()) + 1e-3:
        return f"{lost:.3g} of the draws are below the horizon, {due:.3g} by pdf"
    table = counts[:-1].reshape(COLUMNS, ROWS) / cells
    around, outward = table.mean(axis=1), table.mean(axis=0)
    if np.ptp(around) > np.ptp(outward):
        k = int(np.argmax(np.abs(around - 1.0)))
        degrees = (k + 0.5) / COLUMNS * 360.0
        return f"azimuths about {degrees:.0f} degrees: {around[k]:.3g} of what pdf says"
    inner, outer = outward[0], outward[-1]
    kind = "wider" if inner < outer else "narrower"
    return f"draws are {kind} than pdf: {inner:.3g} of it at the centre, {outer:.3g} at the end"


def judged(counts: Any, probability: Any, level: float) -> Fit:
    """Distance, upper bound and p-value of counts; a last cell hardly expected is merged."""
    from scipy.special import chdtrc, ndtri

    n = float(counts.sum())
    if probability[-1] * n < 10.0:
        if counts[-1] > 40.0 + 10.0 * probability[-1] * n:
            return Fit(math.sqrt(counts[-1] / n), math.inf, 0.0, int(n))
        counts, probability = counts[:-1], probability[:-1] / probability[:-1].sum()
    used = float(counts.sum())
    chi2 = float(np.sum((counts - used * probability) ** 2 / (used * probability)))
    dof = len(counts) - 1
    excess = max(chi2 - dof, 0.0)
    spread = math.sqrt(2.0 * dof + 4.0 * excess)  # of a non-central chi2
    upper = math.sqrt((excess + float(-ndtri(level)) * spread) / used)
    return Fit(math.sqrt(excess / used), upper, float(chdtrc(dof, chi2)), int(n))
