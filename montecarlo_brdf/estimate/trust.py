"""Whether an estimator can be believed for a case: what its own samples can never show.

Cosine sampling of a lobe of width 0.001 may never hit it: all replicates agree and the answer is
wrong. So the spread an estimator must have is predicted from draws that do see the lobe, the
model's own sampler, and from the value of f where lobes are expected; and a density that leaves
f cos/pdf unbounded at the horizon is recognised by the exponent of f there.
"""
from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

from montecarlo_brdf.estimate import probe
from montecarlo_brdf.estimate.ends import Ends, at_ends
from montecarlo_brdf.model import Model, Property
from montecarlo_brdf.sampling.directions import Sampler
from montecarlo_brdf.statistics import Estimate
from montecarlo_brdf.vectors import Vec

#: Effective samples below which an error bar is not trusted.
FEWEST = 1000.0
#: Largest share that a single value may have, seen or expected, of the total and of the sum of
#: squared deviations: the skewness of a mean is then 0.14 at most, and t's tails are nearly right.
LARGEST_SHARE = 0.02
#: Deviations below this, relative to the mean, are not looked at: rounding is of their order.
SMALLEST = 1e-6
#: Rejected draws, expected among the samples, from which their number tells their share.
FEWEST_REJECTED = 16.0
#: Means whose squares are numbers.
SQUARED = (1e-150, 1e150)
#: mu^c/pdf for these densities
SCALE = {Sampler.UNIFORM: 2.0 * math.pi, Sampler.COSINE: math.pi}
#: c in pdf ~ mu^c near the horizon
DENSITY = {Sampler.UNIFORM: 0.0, Sampler.COSINE: 1.0}


class Measurement(NamedTuple):
    """One estimator's answer; `unfit` says why it must not be believed.

    A deterministic estimator knows a bound on its error instead of a spread: `bound`.
    """

    estimator: str
    estimate: Estimate
    unfit: str | None = None
    bound: float | None = None
    needs: float = 0.0  # samples that would make it fit, 0 if that is not known

    def half_width(self, level: float) -> float:
        """Half the width of the interval that misses the truth with probability `level` at most."""
        return self.estimate.half_width(level) if self.bound is None else self.bound

    def times(self, factor: float) -> Measurement:
        """The measurement of `factor` > 0 times the number."""
        bound = None if self.bound is None else factor * self.bound
        return self._replace(estimate=self.estimate.times(factor), bound=bound)


class Unfit(NamedTuple):
    """Why an estimate must not be believed, and how many samples would cure it, 0 if unknown."""

    reason: str
    needs: float = 0.0

    def __str__(self) -> str:
        curable = 0.0 < self.needs < math.inf
        return f"{self.reason}: needs about {self.needs:.0e}" if curable else self.reason


class Sight(NamedTuple):
    """What is known about a case before it is sampled."""

    highest: float  # largest f found where a lobe may be, 1/sr
    brightest: float  # the same of f cos
    exponent: float  # s in f ~ mu_i^-s near the horizon
    signed: bool = False  # whether f may be negative: its mean then is small for no lack of samples
    ends: Ends = Ends()  # of the own sampler's numbers

    def under(self, brightness: float) -> Sight:
        """The same of f under so bright a light."""
        highest, brightest = brightness * self.highest, brightness * self.brightest
        return self._replace(highest=highest, brightest=brightest)

    def largest(self, sampler: Sampler) -> float:
        """The largest f cos/pdf to be expected."""
        return SCALE[sampler] * (self.highest if DENSITY[sampler] else self.brightest)


@functools.lru_cache(maxsize=1024)
def look(model: Model, one: Any, fixed: Vec, own: bool = True) -> Sight:
    """Probe f around the mirror direction and at the horizon, and the sampler at its ends: once,
    however often a claim takes more samples. own: whether that sampler is used at all."""
    ready = model.prepared(one)
    exponent = probe.horizon_exponent(model, ready, fixed)
    signed = Property.POSITIVITY in model.disclaims
    ends = at_ends(model, ready, fixed) if own else Ends()
    return Sight(*probe.highest(model, ready, fixed), exponent, signed, ends)


def moment_is_finite(moment: int, sampler: Sampler, exponent: float) -> bool:
    """E[(f cos/pdf)^moment] with f ~ mu^-s, cos/pdf ~ mu^(1-c), pdf ~ mu^c near mu = 0."""
    c = DENSITY[sampler]
    return moment * (exponent - 1.0 + c) < 1.0 + c - 1e-3


def measured(
    sampler: str, e: Estimate, sight: Sight, second: Estimate | None = None
) -> Measurement:
    """What an estimator says, and why it must not be believed if so.

    `second` estimates E[x^2] of this sampler from draws by the model's own.
    """
    if sampler not in SCALE:
        e = heeding_ends(heeding_rejected(e, sight.ends.rejected), sight.ends)
    unfit = reason_unfit(sampler, e, sight, second)
    return Measurement(sampler, e, str(unfit) if unfit else None, needs=unfit.needs if unfit else 0)


def heeding_rejected(e: Estimate, share: float) -> Estimate:
    """The estimate with no smaller error than rejected draws make that are too few to be counted.

    A narrow lobe gives equal weights and, once in 10^3 to 10^6 draws, none: until one of these is
    drawn all replicates agree on a mean that is too large by their share.
    """
    if share == 0.0 or share * e.samples >= FEWEST_REJECTED:
        return e
    return e._replace(stderr=max(e.stderr, share * abs(e.mean)))


def heeding_ends(e: Estimate, ends: Ends) -> Estimate:
    """The estimate with no smaller error than the draws nearest to the ends are known to make.

    Where they make nearly all of it (Phong's weights at the normal fall like a logarithm), sixteen
    replicates whose spread happens to be small are those that miss the truth.
    """
    if not e.replicates:
        return e
    many = len(e.replicates)
    known = ends.spread(e.samples / many) / math.sqrt(many)
    return e._replace(stderr=max(e.stderr, known * abs(e.mean)))


def reason_unfit(
    sampler: str, e: Estimate, sight: Sight, second: Estimate | None
) -> Unfit | None:
    """Why the estimate by `sampler` must not be believed, or None; arguments as in `measured`."""
    if e.mean == 0.0 and sight.highest > 0.0 and sampler in SCALE:
        return Unfit(f"a lobe that {sampler} sampling did not hit once in {e.samples} samples")
    if not e.mean > 0.0:
        return None
    if beyond := unsquared(e):
        return beyond
    if sampler not in SCALE:
        return _few(sampler, e, e.second_moment, signed=sight.signed)
    squares = max(e.second_moment, second.mean if second else 0.0)
    return _blind(Sampler(sampler), e, squares, sight)


def _blind(sampler: Sampler, e: Estimate, squares: float, sight: Sight) -> Unfit | None:
    """Of directions that know nothing of the model."""
    if not moment_is_finite(2, sampler, sight.exponent):
        grows = f"f grows like mu^-{sight.exponent:.2f}"
        return Unfit(f"infinite variance under {sampler} sampling: {grows}", math.inf)
    if not moment_is_finite(4, sampler, sight.exponent):
        useless = "its error bar can not be trusted"
        return Unfit(f"infinite fourth moment under {sampler} sampling: {useless}", math.inf)
    expected = sight.largest(sampler)
    hardly = None if sight.signed else hardly_hit(sampler, e, expected)
    return hardly or _few(sampler, e, squares, expected, sight.signed)


def unsquared(e: Estimate) -> Unfit | None:
    """Whether a mean is so small or large that its spread is none."""
    if SQUARED[0] < e.mean < SQUARED[1]:
        return None
    return Unfit(f"values of {e.mean:.0e}, whose squares leave the range of numbers")


def hardly_hit(sampler: str, e: Estimate, expected: float) -> Unfit | None:
    """Whether a value as large as `expected` would make more of the total than one may."""
    if expected > LARGEST_SHARE * e.samples * e.mean:
        need = expected / (LARGEST_SHARE * e.mean) if e.mean > 0.0 else 0.0
        return Unfit(f"a lobe that {sampler} sampling hardly hits", need)
    return None


def _few(
    sampler: str, e: Estimate, squares: float, highest: float = 0.0, signed: bool = False
) -> Unfit | None:
    """Why so few samples carry the mean, or its spread, that its error bar must not be believed,
    or None; squares: E[x^2]; highest: the largest x expected."""
    if not signed and (reason := few_carry(sampler, e, squares)):
        return reason
    return _few_spread(sampler, e, squares, highest)


def few_carry(sampler: str, e: Estimate, squares: float) -> Unfit | None:
    """The mean of what is never negative; squares: E[x^2]."""
    if e.largest > LARGEST_SHARE * e.samples * e.mean:
        share = e.largest / (e.samples * e.mean)
        return Unfit(f"one sample holds {share:.0%} of the total under {sampler} sampling")
    effective = e.samples * e.mean**2 / squares
    if effective < FEWEST:
        need = e.samples * FEWEST / effective
        return Unfit(f"{effective:.0f} effective samples under {sampler} sampling", need)
    return None


def _few_spread(sampler: str, e: Estimate, squares: float, highest: float) -> Unfit | None:
    """The spread."""
    most = max(e.largest, highest) - e.mean
    spread = e.samples * (squares - e.mean**2)
    if most > SMALLEST * e.mean and most**2 > LARGEST_SHARE * spread:
        need = e.samples * most**2 / (LARGEST_SHARE * spread) if spread > 0.0 else math.inf
        return Unfit(f"few samples make the spread under {sampler} sampling", need)
    return None
