"""What a check asserts: a number that can be estimated to any precision. Never a verdict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.estimate.trust import Measurement
from montecarlo_brdf.judge.finding import Bound, Verdict
from montecarlo_brdf.model import Property
from montecarlo_brdf.statistics import quantile

#: Tolerances are stated, not discovered: docs/statistics.md.
BOUND_TOLERANCE = 1e-5  # absolute, for "at most 1"
AGREEMENT_TOLERANCE = 1e-4  # relative, for "equals its reference"


class Kind(StrEnum):
    """Where an expected value is from."""

    BOUND = "bound"
    LAW = "law"
    CLOSED_FORM = "closed form"
    QUADRATURE = "quadrature"  # of a formula of our own
    INDEPENDENT = "independent"  # a sum of several kinds
    DECLARED = "declared"
    OTHER_MODEL = "other model"
    SAME_F = "quadrature of the same f"  # says nothing about f itself
    ADAPTIVE = "adaptive estimate of the same f"


class Reference(NamedTuple):
    """An expected value with the bound on its own error, and where it is from."""

    value: float
    error: float
    kind: Kind | None = None  # None: a bare number
    source: str = ""

    @classmethod
    def of(cls, value: float, error: float, kind: str, source: str) -> Reference:
        """A truth of `references`, which know no type of ours."""
        return cls(float(value), float(error), Kind(kind), source)

    def told(self) -> dict[str, Any] | None:
        """What a finding tells of it besides its value; nothing of a bare number."""
        if self.kind is None:
            return None
        return {"kind": self.kind, "source": self.source, "error": self.error}

    def times(self, factor: float) -> Reference:
        """What is expected of `factor` times the number."""
        return self._replace(value=factor * self.value, error=abs(factor) * self.error)

    def excess(self, bound: Bound, value: float) -> float:
        """How far a value lies outside its bound."""
        over = value - self.value
        return abs(over) if bound == Bound.EQUAL else -over if bound == Bound.AT_LEAST else over

    def verdict(self, bound: Bound, value: float, error: float, tolerance: float) -> Verdict:
        """Held or refuted surely, whatever both errors hide, or inconclusive."""
        if not math.isfinite(value):
            return Verdict.FAIL
        over, slack = self.excess(bound, value), error + self.error
        if over + slack <= tolerance:
            return Verdict.PASS
        return Verdict.FAIL if over - slack > tolerance else Verdict.INCONCLUSIVE


class Exact(NamedTuple):
    """The outcome of a deterministic evaluation: the worst value found, its error bound, where."""

    value: float
    error: float = 0.0
    where: Mapping[str, Any] = {}
    points: int = 1  # how many were looked at
    note: str | None = None  # why nothing could be decided
    hint: str | None = None
    example: str | None = None  # what was found there, told where it refutes
    reproduce: str | None = None  # the command that shows it again


def worst_of(looks: Iterable[Exact]) -> Exact:
    """The largest of some values, of equal ones the last, with the points of all."""
    looks = list(looks)
    found: Exact = max(reversed(looks), key=lambda one: one.value)
    return found._replace(points=sum(one.points for one in looks))


class Fit(NamedTuple):
    """How far counts are from what a density says: a distance with an upper bound, and a
    p-value."""

    distance: float
    upper: float
    p_value: float
    samples: int
    note: str | None = None  # why the density could not be integrated
    hint: str | None = None
    draws: Mapping[str, Any] | None = None  # the counts in their cells, for pictures


class Slope(NamedTuple):
    """How the logarithm of an error changes with that of the samples; NaN: nothing to fit."""

    value: float
    stderr: float
    dof: int
    samples: int  # of the last error
    levels: list[dict[str, Any]]  # the errors as a finding shows them
    note: str
    finite: bool = True  # whether all errors are numbers
    doubt: str | None = None  # why a slope that is too flat refutes nothing

    def half_width(self, level: float) -> float:
        """Half the width of the slope's interval."""
        return quantile(0.5 * level, self.dof) * self.stderr


@dataclass(frozen=True)
class ExactClaim:
    """A number that a deterministic evaluation, or the worst of a search, keeps within bounds."""

    quantity: str
    where: Mapping[str, Any]
    bound: Bound
    expected: Reference
    tolerance: float  # absolute
    evaluate: Callable[[], Exact]
    property: str | None = Property.REFERENCE
    estimator: str = "exact"


@dataclass(frozen=True)
class FitClaim:
    """Samples follow a density: the distance of their distributions is below the tolerance."""

    quantity: str
    where: Mapping[str, Any]
    tolerance: float
    measure: Callable[[Plan, float], Fit]  # plan and level
    property: str | None = Property.PDF


@dataclass(frozen=True)
class SlopeClaim:
    """An error falls with the number of samples: its slope is at most what is expected."""

    quantity: str
    where: Mapping[str, Any]
    expected: Reference
    tolerance: float  # absolute
    measure: Callable[[Plan], Slope]
    property: str | None = None


@dataclass(frozen=True)
class Skip:
    """A question that does not apply, with the reason."""

    quantity: str
    reason: str
    property: str | None = None


@dataclass(frozen=True)
class Limit:
    """How far something holds: a number that is told, as nobody promised any."""

    quantity: str
    where: Mapping[str, Any]
    value: float  # NaN: it holds nowhere
    samples: int
    estimator: str
    note: str | None = None  # why there is none
    property: str | None = None


@dataclass(frozen=True)
class MeanClaim:
    """A mean that is at most, or equals, an expected value within a tolerance.

    `measure(plan)` gives one measurement per estimator. `expected` None means that the estimators
    are held against each other. `property` names what a model may disclaim.
    """

    quantity: str
    where: Mapping[str, Any]
    bound: Bound
    expected: Reference | None
    tolerance: float  # absolute
    measure: Callable[[Plan], list[Measurement]]
    property: str | None = Property.REFERENCE
    unit: Mapping[str, float] = field(default_factory=dict)  # what the hint compares the value with
    diagnosis: Callable[[], str | None] | None = None  # the hint, asked for first
    cause: Callable[[], str] | None = None  # the hint where no number tells
    #: asked, for a seed, where samples leave the claim open
    fallback: Callable[[int], Measurement] | None = None
    #: what is expected by another quadrature, for a seed; None where that resolves nothing
    afresh: Callable[[int], Reference | None] | None = None
    #: whether it is about f alone: the model's own sampler may hold it, but never refute it
    of_f: bool = False


Claim = MeanClaim | ExactClaim | FitClaim | SlopeClaim | Limit | Skip
