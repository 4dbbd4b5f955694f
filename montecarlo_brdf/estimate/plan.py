"""How an estimate is sampled, and the arguments of it that come from users: checked once."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from typing import TYPE_CHECKING, Any, NamedTuple

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.model import Model
from montecarlo_brdf.sampling.points import SETS, PointSet

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

Progress = Callable[[float], None]  # gets the fraction done

REPLICATES = 16
MOST_SAMPLES = 1 << 40
TARGETS = (1e-13, 1.0)  # relative errors that may be asked for


class Choice(StrEnum):
    """Who chooses sampler and points."""

    GIVEN = "given"  # whoever asks
    AUTO = "auto"  # the model and the target


class Plan(NamedTuple):
    """How to sample."""

    points: PointSet = PointSet.SOBOL
    samples: int = 1 << 16
    replicates: int = REPLICATES
    seed: int = 0
    threads: int = 1
    target_error: float | None = None  # relative; None: just the samples asked for
    method: Choice = Choice.GIVEN  # AUTO also without a target
    sums: PartialSums | None = None  # where long jobs keep how far they are
    effort: float = 1.0  # in (0, 1]: the share of pairs, places and nodes that checks look at
    reach: int = 0  # samples, where those allowed leave open what so many decide


def check_points(points: str) -> PointSet:
    """A point set by its name, or a UserError."""
    if points not in SETS:
        raise UserError(unknown("point set", points, SETS))
    return PointSet(points)


def check_samples(samples: Any) -> None:
    """Raise UserError unless it is a number of samples between 1 and 2^40."""
    whole = not isinstance(samples, bool) and isinstance(samples, int)
    if not (whole and 1 <= samples <= MOST_SAMPLES):
        raise UserError(f"samples must be a whole number from 1 to 2^40, not {samples}")


def check_method(method: str | None, target_error: Any) -> Choice:
    """Who chooses, which is the model where a target is all that is said. Raises UserError for a
    method that is none, or a target that is no relative error in [1e-13, 1)."""
    if method is not None and method not in list(Choice):
        raise UserError(unknown("method", method, Choice))
    low, high = TARGETS
    if target_error is None:
        return Choice(method or Choice.GIVEN)
    number = isinstance(target_error, int | float) and not isinstance(target_error, bool)
    if not (number and low <= target_error < high):
        allowed = f"a relative error in [{low:g}, {high:g})"
        raise UserError(f"target_error must be {allowed}, not {target_error}")
    return Choice(method or Choice.AUTO)


def check_subject(model: Any, p: Any) -> None:
    """Raise UserError unless these are a model and a parameter set of such."""
    if not isinstance(model, Model):
        raise UserError(f"model must be a Model, as load({model!r}) gives it, not {model!r}")
    if not (isinstance(p, tuple) and hasattr(p, "_fields")):
        raise UserError(f"p must be what model.parameters(...) gives, not {p!r}")


def check_theta(theta_deg: Any, name: str = "theta_o_deg") -> float:
    """A polar angle in [0, 90) degrees, or a UserError."""
    try:
        theta = float(theta_deg)
    except (TypeError, ValueError):
        theta = math.nan
    if not 0.0 <= theta < 90.0:
        raise UserError(f"{name} must be an angle in [0, 90) degrees, not {theta_deg}")
    return theta
