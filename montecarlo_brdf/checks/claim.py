"""What a check asserts: a number that can be estimated to any precision. Never a verdict."""
from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from montecarlo_brdf.integration.estimators import Plan
from montecarlo_brdf.statistics import Estimate

#: Tolerances are stated, not discovered (design: the verdict is the product).
BOUND_TOLERANCE = 1e-5  # absolute, for "at most 1"
AGREEMENT_TOLERANCE = 1e-4  # relative, for "equals its reference"


class Reference(NamedTuple):
    """An expected value with the bound on its own error, and where it is from."""

    value: float
    error: float
    kind: str
    source: str


class Measurement(NamedTuple):
    """One estimator's answer; `unfit` says why it must not be believed."""

    estimator: str
    estimate: Estimate
    unfit: str | None = None


@dataclass(frozen=True)
class MeanClaim:
    """A mean that is at most, or equals, an expected value within a tolerance.

    `measure(plan)` gives one measurement per estimator. `expected` None means that the estimators
    are held against each other. `property` names what a model may disclaim.
    """

    quantity: str
    where: Mapping[str, Any]
    bound: str  # "at most" or "equal"
    expected: Reference | None
    tolerance: float  # absolute
    measure: Callable[[Plan], list[Measurement]]
    property: str = "reference"
    reproduce: str = ""
    unit: Mapping[str, float] = field(default_factory=dict)  # what the hint compares the value with
