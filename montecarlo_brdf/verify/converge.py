"""Convergence: does the error fall with the number of samples as point set and sampler promise?

A rate is a claim about point set, sampler and smoothness together, never about a point set alone:
in a chart fitted to the model the integrand is smooth; elsewhere the horizon cuts it or a kink lies
in it. Errors are those of single randomisations against the reference; the slope of log error
against log N is fitted where the error is below 10 % and well above the reference's own. It cannot
see: an error that is the same at every N.
"""
from __future__ import annotations

import functools
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.checks import _density, _truth
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.estimators import directional_albedo
from montecarlo_brdf.estimate.evaluate import estimates
from montecarlo_brdf.estimate.plan import Plan, Progress, check_theta
from montecarlo_brdf.estimate.quantity import Quantity
from montecarlo_brdf.estimate.samplers import charts_of, integrand, samplers_of
from montecarlo_brdf.judge.claim import Kind, Reference, Slope, SlopeClaim
from montecarlo_brdf.judge.decide import LEVEL, SHOWN
from montecarlo_brdf.judge.finding import Command, Report
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.directions import DIRECTIONS, Sampler
from montecarlo_brdf.sampling.points import SETS, PointSet
from montecarlo_brdf.statistics import quantile
from montecarlo_brdf.verify.question import (
    Question,
    Sets,
    Settings,
    answered,
    chosen,
    parameter_sets,
)

NAME = "convergence"
SAMPLES = 1 << 21  # per level, over all randomisations

#: the slope that is claimed at most, by point set: (smooth in the fitted chart, cut or kinked)
CLAIMS: dict[str, tuple[float, float]] = {
    PointSet.INDEPENDENT: (-0.5, -0.5),
    PointSet.STRATIFIED: (-0.9, -0.75),
    PointSet.SOBOL: (-1.1, -0.75),
    PointSet.LATTICE: (-1.9, -0.75),
}
SLACK = 0.05  # the slope -1/2 is exact: its estimate lies on both sides of it
RANDOMISATIONS = 32
#: of independent points, whose slope is its claim: SLACK is six standard errors then, not three
RANDOMISATIONS_INDEPENDENT = 256
FIRST, CONSTANT = 4, 1e-13  # log2 of the fewest samples; an error below that is rounding
USABLE = 0.1  # relative error above which a lobe is not yet resolved
USABLE_INDEPENDENT = 1.0  # independent points have the same slope at every N
FINE = 1e-11  # relative error of a quadrature that errors are measured against
FEWEST = 4  # levels that a fit needs
CLEAR = 10.0  # times the reference's own error, which then bends log2(error) by 0.14 at most
LEAST = 0.05  # relative uncertainty of an error: no level decides a slope alone
#: a reference that is estimated: the relative error asked for, and standard errors that bound it
ESTIMATED, SURE = 1e-10, 4.0
TARGETS = (1e-3, 1e-6, 1e-9)


def converge(
    model: Model, p: Sets = None, theta_o_deg: float = 60.0, *, phi_o_deg: float = 0.0,
    sampler: str | Sequence[str] = "all", points: str | Sequence[str] = "all",
    samples: int = SAMPLES, seed: int = 0, threads: int | None = None,
    progress: Progress | None = None,
) -> Report:  # fmt: skip
    """How fast the error of A falls for each sampler and point set, against the claimed rate.

    model: from `load`. p: a parameter set of `model.parameters`, a list of them, or None for the
    defaults. theta_o_deg, phi_o_deg: the viewer's polar angle in [0, 90) and azimuth, in degrees.
    sampler: "all" or some of "uniform", "cosine", "own", "half_vector", "mirror", "panels". points:
    "all" or some of "independent", "stratified", "sobol", "lattice". samples: the most that one
    number of samples may take over its 32 randomisations, 1 to 2^40. seed: 0 to 2^64 - 1. threads:
    1 to 1024, None for all processors; no result depends on it. progress: is called with the
    fraction done.

    Returns a Report with one Result per parameter set. Raises UserError for a bad value, ModelError
    if the model does not run, TooSlow if it does not return.
    """
    theta = check_theta(theta_o_deg)
    samplers = chosen("sampler", sampler, (*charts_of(model), *samplers_of(model)))
    sets = chosen("point set", points, tuple(SETS))
    settings = Settings.of(sets[0], samples, seed, threads)
    fewest = max(map(randomisations, sets)) << FIRST
    if samples < fewest:
        one = "one point of a curve"
        raise UserError(f"samples must be at least {fewest} for {one}, not {samples}")
    cases = [
        Case(model.of(one), one, [theta], phi_o_deg, seed=seed) for one in parameter_sets(model, p)
    ]
    claimed = functools.partial(claims, samplers=samplers, sets=sets)
    questions = [Question(NAME, case, claimed) for case in cases]
    told = {"theta_o_deg": theta, "phi_o_deg": phi_o_deg, "sampler": samplers}
    told |= {**settings.told(), "points": ", ".join(sets)}
    count = len(samplers) * len(sets)
    report = answered(Command.CONVERGE, told, questions, settings.plan, count, progress)
    # a rate accuses no line of f
    return replace(report, results=[replace(r, source={}) for r in report.results])


def claims(case: Case, samplers: Sequence[str], sets: Sequence[str]) -> Iterator[SlopeClaim]:
    """One claim per sampler and point set."""
    known = reference_of(case)
    floor = max(known.error / abs(known.value), 4.0 * 2.0**-52)
    (theta,) = case.theta_o_deg
    for sampler in samplers:
        kinked = case.model.kinks and sampler != Sampler.PANELS
        smooth = DIRECTIONS[Sampler(sampler)].periodic and not kinked
        for points in sets:
            rate = CLAIMS[_claimed_as(case, sampler, points)][0 if smooth else 1]
            blind = known.kind is Kind.SAME_F and sampler != Sampler.OWN
            curve = Curve(case, sampler, points, smooth, known.value, floor, blind)
            yield SlopeClaim(
                "slope", {**case.where(theta_o_deg=theta), "sampler": sampler, "points": points},
                Reference(rate, floor, known.kind, known.source), SLACK, curve.slope,
            )  # fmt: skip


def reference_of(case: Case) -> Reference:
    """The reference; for a model without one, an adaptive estimate with its own error bar."""
    (theta,) = case.theta_o_deg
    place = case.model, case.one, theta, case.phi_o_deg
    found = _truth.independent(*place) or _truth.same_f(*place, target=FINE, sure=True)
    if found is None or not found.value:
        e = directional_albedo(
            case.model, case.one, theta, phi_o_deg=case.phi_o_deg, target_error=ESTIMATED
        )
        found = Reference(e.mean, SURE * e.stderr, Kind.ADAPTIVE, e.method)
    if not found.value:
        raise UserError(f"model {case.model.name} reflects nothing here: no relative error")
    return found


def _claimed_as(case: Case, sampler: str, points: str) -> str:
    """Jittered grids spread two numbers at a time: with a lobe chosen by a third they converge like
    independent points."""
    grid = points == PointSet.STRATIFIED and sampler == Sampler.OWN
    return PointSet.INDEPENDENT if grid and _density.chooses(case, case.theta_o_deg[0]) else points


class Level(NamedTuple):
    """The errors of R randomisations with N samples each, relative to the reference."""

    samples: int
    error: float  # root mean square
    uncertainty: float  # of log2(error)
    each: tuple[float, ...]
    apart: float  # by how much their mean surely differs from the reference


class Line(NamedTuple):
    """A straight line through log2(error) against log2(N)."""

    slope: float
    stderr: float
    origin: float
    dof: int


class Curve(NamedTuple):
    """Error against N of one sampler with one point set."""

    case: Case
    sampler: str
    points: str
    smooth: bool
    truth: float
    floor: float  # relative error that the truth itself may have
    of_f_alone: bool = False  # whether the truth is of the same f, and nothing else is sampled

    def slope(self, plan: Plan) -> Slope:
        """The slope with what a finding tells; plan.samples is the most that a level may take."""
        levels = self.levels(plan)
        line = self.fitted(levels)
        fit = line or Line(math.nan, math.nan, math.nan, 1)
        found = Slope(
            fit.slope, fit.stderr, fit.dof, samples=levels[-1].samples if levels else 0,
            levels=[_row(v) for v in levels], note="",
            finite=not any(math.isnan(v.error) for v in levels), doubt=self.doubt(levels),
        )  # fmt: skip
        return found._replace(note=self.note(found, levels, line))

    def levels(self, plan: Plan) -> list[Level]:
        """Double N until the error is as small as that of the reference or samples run out."""
        levels: list[Level] = []
        n, most = 1 << FIRST, plan.samples // randomisations(self.points)
        while n <= most and not (levels and levels[-1].error < 2.0 * self.floor):
            levels.append(self.level(plan, n))
            n *= 2
        return levels

    def level(self, plan: Plan, n: int) -> Level:
        """The errors at N = n."""
        case, replicates = self.case, randomisations(self.points)
        many = plan._replace(samples=n * replicates, replicates=replicates)
        many = many._replace(points=PointSet(self.points))
        means = [integrand(case.model, Quantity.ALBEDO, self.sampler)]
        # a stream of its own per N: errors at different N are independent, as the fit assumes
        stream = (NAME, self.sampler, n)
        wo = case.wo(case.theta_o_deg[0])
        row = estimates(case.model, case.one, wo, means, many, stream)
        signed = [m / self.truth - 1.0 for m in row[0][0].replicates]
        each = tuple(map(abs, signed))
        squares = [e * e for e in each]
        mean = math.fsum(squares) / len(squares)
        spread = math.fsum([(s - mean) ** 2 for s in squares]) / (len(squares) - 1)
        relative = math.sqrt(spread / len(squares)) / mean if mean else 0.0
        uncertainty = max(0.5 * relative, LEAST) / math.log(2.0)
        return Level(n, math.sqrt(mean), uncertainty, each, surely_apart(signed))

    def doubt(self, levels: Sequence[Level]) -> str | None:
        """That two numbers of the tool's own differ, where no slope would say more than that."""
        if not (self.of_f_alone and levels and levels[-1].apart > self.floor):
            return None
        last = levels[-1]
        return (
            f"not resolved: {self.sampler} sampling differs by {last.apart:.1e} from the "
            f"quadrature of the same f, {self.truth:.8g} +- {self.floor * abs(self.truth):.1e}: "
            f"decide it with furnace --samples {2 * last.samples * randomisations(self.points)}"
        )

    def fitted(self, levels: Sequence[Level]) -> Line | None:
        """The line through the levels that are of use, if there is any."""
        usable = USABLE_INDEPENDENT if self.points == PointSet.INDEPENDENT else USABLE
        line = fitted(levels, self.floor, usable)
        if line is None and self.smooth and levels[-1].error >= USABLE:
            line = fitted(levels, self.floor, math.inf)  # a fitted chart has no excuse
        return line

    def note(self, slope: Slope, levels: Sequence[Level], line: Line | None) -> str:
        """Samples of one randomisation for each target, extrapolated ones in brackets."""
        kind = "smooth in the fitted chart" if self.smooth else "cut or kinked"
        name = f"{self.sampler} x {self.points} ({kind})"
        needs = {t: needed(t, levels, line) for t in TARGETS}
        text = ", ".join(f"{t:g}: {_power(n, n > slope.samples)}" for t, n in needs.items())
        if line:
            low, high = (line.slope + s * slope.half_width(SHOWN) for s in (-1, 1))
            return f"{name}: slope in [{low:.2f}, {high:.2f}]; samples for {text}"
        worst = max((v.error for v in levels), default=0.0)
        few = "too few errors between 10 % and rounding"
        reason = "exact at every N" if worst < CONSTANT else few
        return f"{name}: no slope, {reason}; samples for {text}"


def surely_apart(errors: Sequence[float]) -> float:
    """How far the mean of errors is from 0 beyond half of its interval."""
    many = len(errors)
    mean = math.fsum(errors) / many
    spread = math.fsum((e - mean) ** 2 for e in errors) / (many * (many - 1))
    return abs(mean) - quantile(LEVEL / 2.0, many - 1) * math.sqrt(spread)


def randomisations(points: str) -> int:
    """How many a level takes."""
    return RANDOMISATIONS_INDEPENDENT if points == PointSet.INDEPENDENT else RANDOMISATIONS


def fitted(levels: Sequence[Level], floor: float, usable: float = USABLE) -> Line | None:
    """Weighted least squares; the spread about the line counts where it exceeds what R allows."""
    used = [v for v in levels if max(CLEAR * floor, CONSTANT) < v.error < usable]
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
    return Line(slope, math.sqrt(max(1.0, chi2 / dof) / sxx), y0 - slope * x0, dof)


def needed(target: float, levels: Sequence[Level], line: Line | None) -> float:
    """Samples at which the error falls below a target: measured, else extrapolated."""
    above = [v for v in levels if v.error > target]
    below = [v for v in levels if v.samples > (above[-1].samples if above else 0)]
    if below:
        return float(below[0].samples)
    if line is None or line.slope >= 0.0:
        return math.inf
    return float(2.0 ** min(200.0, (math.log2(target) - line.origin) / line.slope))


def _power(samples: float, extrapolated: bool) -> str:
    if not math.isfinite(samples):
        return "never"
    text = f"2^{math.log2(samples):.1f}" if extrapolated else f"2^{math.log2(samples):.0f}"
    return f"({text})" if extrapolated else text


def _row(level: Level) -> dict[str, Any]:
    """A level as a finding shows it."""
    return {
        "estimator": f"N = {level.samples}", "samples": level.samples, "value": level.error,
        "stderr": level.error * level.uncertainty * math.log(2.0), "verdict": "",
        "randomisations": list(level.each),
    }  # fmt: skip
