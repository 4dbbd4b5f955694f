"""What there is to check: a loaded model with its parameter sets, where to look and how closely.

Jobs come from the command line or from a project's TOML file; both are run in the same way.
"""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from montecarlo_brdf import loading
from montecarlo_brdf.cli._values import models_of, number, numbers, parameter_sets
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.sentences import called
from montecarlo_brdf.verify.common import shown_parameters
from montecarlo_brdf.verify.reproduction import RUN_SAMPLES
from montecarlo_brdf.verify.run import RUN_ANGLES, run


class Job(NamedTuple):
    """One model with one choice of everything that `verify.run` takes."""

    model: Model
    p: list[Any] | None = None  # None: the defaults, and a search over the whole ranges
    fixed: tuple[str, ...] = ()  # parameters that the search leaves alone
    checks: tuple[str, ...] | None = None
    theta_o_deg: Sequence[float] = RUN_ANGLES
    phi_o_deg: float = 0.0
    against: Model | None = None
    points: str = "sobol"
    samples: int = RUN_SAMPLES
    seed: int = 0
    tolerance: float | None = None
    effort: float = 1.0

    def title(self) -> str:
        """'lambert(albedo=0.2)'; of what is searched only the name."""
        if self.p is None:
            return self.model.name
        return called(self.model.name, shown_parameters(self.model.of(self.p[0]), self.p[0]))

    def single(self) -> list[Job]:
        """One job per parameter set."""
        return [self] if self.p is None else [self._replace(p=[one]) for one in self.p]

    def run(self, **rest: Any) -> Report:
        """The report; rest: threads, deadline, progress."""
        given = self._asdict()
        model, p, names = (given.pop(key) for key in ("model", "p", "checks"))
        return run(model, p, names=names, **given, **rest)


def from_options(options: dict[str, Any], seed: int) -> list[Job]:
    """The jobs of a command line: one per model."""
    against = loading.load(options["against"]) if options["against"] else None
    names = options["names"]
    shared: dict[str, Any] = {
        "checks": None if names == "all" else tuple(n.strip() for n in names.split(",")),
        "theta_o_deg": numbers(options["theta_o"], "theta-o"),
        "phi_o_deg": number(options["phi_o"], "phi-o"),
        "against": against,
        "points": options["points"],
        "samples": RUN_SAMPLES if options["samples"] is None else options["samples"],
        "seed": seed,
        "tolerance": options["tolerance"],
        "effort": options["effort"],
    }
    specs = models_of(options["spec"])
    return [with_parameters(loading.load(s), options["assignments"], shared) for s in specs]


def with_parameters(model: Model, assignments: Sequence[str], shared: dict[str, Any]) -> Job:
    """The job for parameters written as -p takes them."""
    if not assignments:
        return Job(model, **shared)
    fixed = tuple(a.partition("=")[0].strip() for a in assignments)
    return Job(model, parameter_sets(model, assignments), fixed, **shared)
