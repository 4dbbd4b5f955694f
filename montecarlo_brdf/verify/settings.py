"""How closely to look: what all questions share, checked once and made into a plan once."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.estimate import adaptive
from montecarlo_brdf.estimate.arguments import check_samples
from montecarlo_brdf.estimate.plan import Choice, Plan
from montecarlo_brdf.sampling.points import SETS

if TYPE_CHECKING:
    from montecarlo_brdf.estimate.partial_sums import PartialSums

SAMPLES = 1 << 22


@dataclass(frozen=True)
class Settings:
    """Everything that a question takes besides its subject and its places.

    Raises UserError for a value that is not allowed.
    """

    points: str = "sobol"
    samples: int = SAMPLES
    seed: int = 0
    threads: int | None = None  # None: all processors
    tolerance: float | None = None  # None: each claim's own
    target_error: float | None = None  # relative
    method: str | None = None  # a Choice; None: AUTO with a target
    sums: PartialSums | None = None
    effort: float = 1.0  # in (0, 1]: the share of pairs, places and nodes that checks look at

    def __post_init__(self) -> None:
        if self.points not in SETS:
            raise UserError(unknown("point set", self.points, SETS))
        threads, seed, tolerance = self.threads, self.seed, self.tolerance
        if threads is not None and not (isinstance(threads, int) and 1 <= threads <= 1024):
            raise UserError(f"threads must be a whole number from 1 to 1024, not {threads}")
        if not isinstance(seed, int) or not 0 <= seed < 1 << 64:
            raise UserError(f"seed must be a whole number from 0 to 2^64 - 1, not {seed}")
        check_samples(self.samples)
        adaptive.check_plan(self.plan)
        if tolerance is not None and not 0.0 <= tolerance < 1.0:
            raise UserError(f"tolerance must be a number in [0, 1), not {tolerance}")
        number = isinstance(self.effort, int | float) and not isinstance(self.effort, bool)
        if not (number and 0.0 < self.effort <= 1.0):
            raise UserError(f"effort must be a number in (0, 1], not {self.effort}")

    @property
    def plan(self) -> Plan:
        """How an estimate is sampled."""
        return Plan(
            points=self.points,
            samples=self.samples,
            seed=self.seed,
            threads=all_threads() if self.threads is None else self.threads,
            target_error=self.target_error,
            method=self.method or (Choice.GIVEN if self.target_error is None else Choice.AUTO),
            sums=self.sums,
            effort=self.effort,
        )

    def told(self) -> dict[str, Any]:
        """What results depend on, for a report; the number of threads is not among it."""
        plan = self.plan
        told: dict[str, Any] = {"points": plan.points, "samples": plan.samples, "seed": plan.seed}
        if plan.effort != 1.0:
            told["effort"] = plan.effort
        if plan.target_error is not None or plan.method != Choice.GIVEN:
            told |= {"target_error": plan.target_error, "method": plan.method}
        return told

    def options(self, default: Settings) -> list[str]:
        """What of points, samples, seed and effort a command line must say: no default."""
        names = ("points", "samples", "seed", "effort")
        said = {n: getattr(self, n) for n in names if getattr(self, n) != getattr(default, n)}
        return [word for name, value in said.items() for word in (f"--{name}", str(value))]

    def tolerance_option(self) -> list[str]:
        """The same for the tolerance."""
        return [] if self.tolerance is None else ["--tolerance", exactly(self.tolerance)]


def all_threads() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def exactly(value: float) -> str:
    """A number with all its digits, and no more."""
    return f"{value:g}" if float(f"{value:g}") == value else repr(float(value))
