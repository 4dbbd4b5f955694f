"""What there is to check: a loaded model with its parameter sets, where to look and how closely.

Requests come from the command line or from a project's TOML file; both are run in the same way.
"""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from montecarlo_brdf.cli._options import parameter_sets
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.text import called
from montecarlo_brdf.verify.question import Progress, shown_parameters
from montecarlo_brdf.verify.run import ANGLES, SAMPLES, run
from montecarlo_brdf.verify.supervision import Deadline


class Terms(NamedTuple):
    """What is asked and how closely: what `verify.run` takes besides a model's parameters."""

    names: tuple[str, ...] | None = None  # of checks; None: all
    theta_o_deg: Sequence[float] = ANGLES
    phi_o_deg: float = 0.0
    against: Model | None = None
    points: str = "sobol"
    samples: int = SAMPLES
    seed: int = 0
    tolerance: float | None = None
    effort: float = 1.0


class Request(NamedTuple):
    """One model and what is asked of it."""

    model: Model
    terms: Terms
    p: list[Any] | None = None  # None: the defaults, and a search over the whole ranges
    fixed: tuple[str, ...] = ()  # parameters that the search leaves alone

    def title(self) -> str:
        """'lambert(albedo=0.2)'; of what is searched only the name."""
        if self.p is None:
            return self.model.name
        return called(self.model.name, shown_parameters(self.model.of(self.p[0]), self.p[0]))

    def single(self) -> list[Request]:
        """One request per parameter set."""
        return [self] if self.p is None else [self._replace(p=[one]) for one in self.p]

    def only(self, *names: str) -> Request:
        """The same for some checks."""
        return self._replace(terms=self.terms._replace(names=names))

    def run(
        self, deadline: Deadline | None = None, threads: int | None = None,
        progress: Progress | None = None,
    ) -> Report:  # fmt: skip
        """The report of `verify.run`."""
        return run(
            self.model, self.p, fixed=self.fixed, deadline=deadline, threads=threads,
            progress=progress, **self.terms._asdict(),
        )  # fmt: skip


def request(model: Model, assignments: Sequence[str], terms: Terms) -> Request:
    """The request for parameters written as -p takes them."""
    if not assignments:
        return Request(model, terms)
    fixed = tuple(a.partition("=")[0].strip() for a in assignments)
    return Request(model, terms, parameter_sets(model, assignments), fixed)
