"""Convergence: does the error fall with the number of samples as point set and sampler promise?

A rate is a claim about point set, sampler and smoothness together, never about a point set alone:
in a chart fitted to the model the integrand is smooth; elsewhere the horizon cuts it or a kink lies
in it. Errors are those of single randomisations against the reference; the slope of log error
against log N is fitted where the error is below 10 % and well above the reference's own. It cannot
see: an error that is the same at every N.
"""
from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from montecarlo_brdf import student
from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _draws
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import integrand
from montecarlo_brdf.judge.claim import Reference
from montecarlo_brdf.sampling.directions import DIRECTIONS, Sampler

NAME = "convergence"

#: the slope that is claimed at most, by point set: (smooth in the fitted chart, cut or kinked)
CLAIMS = {
    "independent": (-0.5, -0.5),
    "stratified": (-0.9, -0.75),
    "sobol": (-1.1, -0.75),
    "lattice": (-1.9, -0.75),
}
SLACK = 0.05  # the slope -1/2 is exact: its estimate lies on both sides of it
RANDOMISATIONS = 32
#: of independent points, whose slope is its claim: SLACK is six standard errors then, not three
RANDOMISATIONS_INDEPENDENT = 256
FIRST, CONSTANT = 4, 1e-13  # log2 of the fewest samples; an error below that is rounding
USABLE = 0.1  # relative error above which a lobe is not yet resolved
USABLE_INDEPENDENT = 1.0  # independent points have the same slope at every N
FEWEST = 4  # levels that a fit needs
LEVEL = 1e-6  # chance that a true claim is refuted
SHOWN = 0.05  # of the interval that is shown and must lie below the claim to hold it
TARGETS = (1e-3, 1e-6, 1e-9)


class Level(NamedTuple):
    """The errors of R randomisations with N samples each, relative to the reference."""

    samples: int
    error: float  # root mean square
    uncertainty: float  # of log2(error)
    each: tuple[float, ...]


class Fit(NamedTuple):
    """A straight line through log2(error) against log2(N)."""

    slope: float
    stderr: float
    origin: float
    dof: int

    def half_width(self, level: float) -> float:
        """Half the width of the slope's interval."""
        return student.quantile(0.5 * level, self.dof) * self.stderr


class Curve(NamedTuple):
    """Error against N of one sampler with one point set, and what is claimed about it."""

    sampler: str
    points: str
    smooth: bool
    claim: float
    floor: float
    levels: list[Level]
    fit: Fit | None

    @property
    def verdict(self) -> str:
        """Held, refuted, undecided, or nothing to decide."""
        if self.fit is None:
            return "fail" if any(math.isnan(v.error) for v in self.levels) else "skipped"
        if self.fit.slope + self.fit.half_width(SHOWN) <= self.claim + SLACK:
            return "pass"
        beyond = self.fit.slope - self.fit.half_width(LEVEL) > self.claim + SLACK
        return "fail" if beyond else "inconclusive"

    def needed(self, target: float) -> float:
        """Samples at which the error falls below a target: measured, else extrapolated."""
        above = [v for v in self.levels if v.error > target]
        below = [v for v in self.levels if v.samples > (above[-1].samples if above else 0)]
        if below:
            return float(below[0].samples)
        if self.fit is None or self.fit.slope >= 0.0:
            return math.inf
        return float(2.0 ** min(200.0, (math.log2(target) - self.fit.origin) / self.fit.slope))


def curves(
    case: Case,
    theta: float,
    samplers: Sequence[str],
    points: Sequence[str],
    plan: Plan,
    known: Reference,
) -> Iterator[Curve]:
    """One curve per sampler and point set; plan.samples is the most that a level may take."""
    for sampler in samplers:
        for one in points:
            yield curve(case, theta, sampler, plan._replace(points=one), known)


def curve(case: Case, theta: float, sampler: str, plan: Plan, known: Reference) -> Curve:
    """Double N until the error is as small as that of the reference or the samples run out."""
    floor = max(known.error / abs(known.value), 4.0 * 2.0**-52)
    levels: list[Level] = []
    n, most = 1 << FIRST, plan.samples // randomisations(plan.points)
    while n <= most and not (levels and levels[-1].error < 2.0 * floor):
        levels.append(_level(case, theta, sampler, plan, known.value, n))
        n *= 2
    kinked = case.model.kinks and sampler != Sampler.PANELS
    smooth = DIRECTIONS[Sampler(sampler)].periodic and not kinked
    claim = CLAIMS[_claimed_as(case, theta, sampler, plan.points)][0 if smooth else 1]
    usable = USABLE_INDEPENDENT if plan.points == "independent" else USABLE
    fit = fitted(levels, floor, usable)
    if fit is None and smooth and levels[-1].error >= USABLE:
        fit = fitted(levels, floor, math.inf)  # a fitted chart has no excuse not to converge
    return Curve(sampler, plan.points, smooth, claim, floor, levels, fit)


def _claimed_as(case: Case, theta: float, sampler: str, points: str) -> str:
    """Jittered grids spread two numbers at a time: with a lobe chosen by a third they converge like
    independent points."""
    chosen = points == "stratified" and sampler == "own" and _draws.chooses(case, theta)
    return "independent" if chosen else points


def randomisations(points: str) -> int:
    """How many a level takes."""
    return RANDOMISATIONS_INDEPENDENT if points == "independent" else RANDOMISATIONS


def _level(case: Case, theta: float, sampler: str, plan: Plan, truth: float, n: int) -> Level:
    replicates = randomisations(plan.points)
    many = plan._replace(samples=n * replicates, replicates=replicates)
    one = integrand(case.model, Quantity.ALBEDO, sampler)
    # a stream of its own per N: errors at different N are independent, as the fit assumes
    row = estimates(case.model, case.one, case.wo(theta), [one], many, (NAME, sampler, n))
    each = tuple(abs(m / truth - 1.0) for m in row[0][0].replicates)
    squares = [e * e for e in each]
    mean = math.fsum(squares) / len(squares)
    spread = math.fsum([(s - mean) ** 2 for s in squares]) / (len(squares) - 1)
    relative = math.sqrt(spread / len(squares)) / mean if mean else 0.0
    return Level(n, math.sqrt(mean), max(0.5 * relative, 0.05) / math.log(2.0), each)


def fitted(levels: Sequence[Level], floor: float, usable: float = USABLE) -> Fit | None:
    """Weighted least squares; the spread about the line counts where it exceeds what R allows."""
    used = [v for v in levels if max(10.0 * floor, CONSTANT) < v.error < usable]
    if len(used) < FEWEST:
        return None
    weights = [v.uncertainty**-2 for v in used]
    xs, ys = [math.log2(v.samples) for v in used], [math.log2(v.error) for v in used]
    total = math.fsum(weights)
    x0 = math.fsum(w * x for w, x in zip(weights, xs, strict=True)) / total
    y0 = math.fsum(w * y for w, y in zip(weights, ys, strict=True)) / total
    sxx = math.fsum(w * (x - x0) ** 2 for w, x in zip(weights, xs, strict=True))
    sxy = math.fsum(w * (x - x0) * (y - y0) for w, x, y in zip(weights, xs, ys, strict=True))
    slope = sxy / sxx
    residuals = [y - y0 - slope * (x - x0) for x, y in zip(xs, ys, strict=True)]
    chi2 = math.fsum(w * r * r for w, r in zip(weights, residuals, strict=True))
    dof = len(used) - 2
    return Fit(slope, math.sqrt(max(1.0, chi2 / dof) / sxx), y0 - slope * x0, dof)
