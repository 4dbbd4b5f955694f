"""Assertions about BRDFs for a test suite: each raises AssertionError with finding and cause.

    from montecarlo_brdf.testing import assert_conserves_energy

    def test_energy():
        assert_conserves_energy(my_module, p={"alpha": 0.2})

A BRDF is given as a model, a built-in name, a path, a function f(wo, wi, p), or anything with an
attribute f: a module, a class. An undecided claim is no proof and raises too, unless
inconclusive="pass".
"""
from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypedDict, Unpack

from montecarlo_brdf import contract, loading
from montecarlo_brdf.errors import ModelError, UserError
from montecarlo_brdf.judge.finding import Policy, Report, Verdict
from montecarlo_brdf.model import Model
from montecarlo_brdf.report.text import case, failures
from montecarlo_brdf.verify.question import INTERRUPTED
from montecarlo_brdf.verify.run import run
from montecarlo_brdf.verify.supervision import Deadline

Parameters = Mapping[str, Any] | tuple[Any, ...] | None

class Terms(TypedDict, total=False):
    """The options of `verify.run` besides model, parameters, checks and deadline."""

    theta_o_deg: Sequence[float]
    phi_o_deg: float
    fixed: Iterable[str]
    against: Model | None
    points: str
    samples: int
    seed: int
    threads: int | None
    tolerance: float | None


class Options(Terms, total=False):
    """Those of `assert_checks`."""

    inconclusive: str
    max_time: float


__all__ = [
    "assert_checks",
    "assert_conserves_energy",
    "assert_converges",
    "assert_furnace",
    "assert_reciprocal",
    "assert_samples_match_pdf",
]


def assert_conserves_energy(
    brdf: object, p: Parameters = None, **options: Unpack[Options]
) -> Report:
    """Nowhere is more reflected than received, in either direction.

    brdf, p, options: as `assert_checks` takes them. Returns the report. Raises what it raises: with
    what was found, where, and the likely cause.
    """
    __tracebackhide__ = True
    return assert_checks(brdf, p, ("energy",), **options)


def assert_reciprocal(brdf: object, p: Parameters = None, **options: Unpack[Options]) -> Report:
    """f(wo, wi) = f(wi, wo).

    brdf, p, options: as `assert_checks` takes them. Returns the report. Raises what it raises: with
    what was found, where, and the likely cause.
    """
    __tracebackhide__ = True
    return assert_checks(brdf, p, ("reciprocity",), **options)


def assert_furnace(
    brdf: object, p: Parameters = None, expected: float | Callable[..., float] | None = None,
    **options: Unpack[Options],
) -> Report:  # fmt: skip
    """The albedo is at most 1 and what it should be.

    expected: a number, or a function of (cos_theta_o, p); None for the model's own reference.
    brdf, p, options: as `assert_checks` takes them. Returns the report. Raises what it raises: with
    what was found, where, and the likely cause.
    """
    __tracebackhide__ = True
    model = as_model(brdf, p)
    if expected is not None:
        albedo = expected if callable(expected) else lambda cos_theta_o, p: expected
        model = dataclasses.replace(model, albedo=albedo)
    return assert_checks(model, p, ("furnace",), **options)


def assert_samples_match_pdf(
    brdf: object, p: Parameters = None, **options: Unpack[Options]
) -> Report:
    """Drawn directions follow pdf, which integrates to 1 less what is rejected.

    brdf, p, options: as `assert_checks` takes them. Returns the report. Raises what it raises: with
    what was found, where, and the likely cause.
    """
    __tracebackhide__ = True
    model = as_model(brdf, p)
    if model.sample is None or model.pdf is None:
        raise UserError(f"model {model.name} has no sample and pdf to hold against each other")
    return assert_checks(model, p, ("pdf", "sampling"), **options)


def assert_converges(
    brdf: object, p: Parameters = None, *, inconclusive: str = Policy.FAIL, **options: Any
) -> Report:
    """The error of every estimator falls with the number of samples as its point set promises.

    brdf: as above. p: a parameter set, as a dictionary or a NamedTuple, or None for the defaults.
    inconclusive: "fail" or "pass", what an undecided claim is. options: those of `verify.converge`.

    Returns the report. Raises AssertionError with what was found, where, and the likely cause,
    UserError for a bad value, ModelError if the BRDF does not run.
    """
    from montecarlo_brdf.verify.converge import converge

    __tracebackhide__ = True
    model = as_model(brdf, p)
    report = converge(model, parameters_of(model, p), **options)
    require(report, inconclusive, reproducible=_loadable(model))
    return report


def assert_checks(
    brdf: object, p: Parameters = None, checks: tuple[str, ...] | None = None, *,
    inconclusive: str = Policy.FAIL, max_time: float = math.inf, **options: Unpack[Terms],
) -> Report:  # fmt: skip
    """Several checks at once, or all of them.

    brdf: as above. p: a parameter set, as a dictionary or a NamedTuple, or None for the defaults,
    around which searches for the worst case look at the whole ranges. checks: names, None for all.
    inconclusive: "fail" or "pass", what an undecided claim is. max_time: seconds after which no
    claim is begun. options: those of `verify.run`.

    Returns the report. Raises AssertionError with what was found, where, and the likely cause,
    UserError for a bad value, ModelError if the BRDF does not run.
    """
    __tracebackhide__ = True
    model = as_model(brdf, p)
    given = parameters_of(model, p)
    report = run(model, given, names=checks, deadline=Deadline(max_time), **options)
    if report.measured[INTERRUPTED]:
        raise KeyboardInterrupt
    require(report, inconclusive, reproducible=_loadable(model))
    return report


def require(report: Report, inconclusive: str = Policy.FAIL, reproducible: bool = True) -> None:
    """Every claim of a report held.

    report: of any question. inconclusive: "fail" or "pass", what an undecided claim is.
    reproducible: whether a command line can name the model. Raises AssertionError with all claims
    that did not hold, ModelError with them if the BRDF ended a check by an exception.
    """
    __tracebackhide__ = True
    bad = {Verdict.ERROR, Verdict.FAIL}
    bad |= set() if inconclusive == Policy.PASS else {Verdict.INCONCLUSIVE}
    lines = failures(report, bad, reproducible)
    if lines:
        cases = ", ".join(dict.fromkeys(case(r) for r in report.results))
        text = "\n".join([f"{cases}: {report.verdict}", *lines])
        raise ModelError(text) if report.verdict == Verdict.ERROR else AssertionError(text)


def _loadable(model: Model) -> bool:
    """Whether a command line can name the model."""
    return model.built_in or bool(model.terms) or loading.is_path(model.name)


def as_model(brdf: object, p: Parameters = None) -> Model:
    """The model that something stands for.

    brdf: as above. p: the parameter set that is meant; of a function without Params its type is
    taken. Raises UserError for anything that is no BRDF, ModelError if a file does not load.
    """
    if isinstance(brdf, Model):
        return brdf
    if isinstance(brdf, (str, os.PathLike)):
        return loading.load(str(Path(brdf)) if isinstance(brdf, os.PathLike) else brdf)
    f = getattr(brdf, "f", brdf)
    if not callable(f):
        raise UserError(f"a BRDF is a model, a name, a path, or has a function f, not {brdf!r}")
    names = () if f is brdf else (k for k in dir(brdf) if not k.startswith("_"))
    inside = {name: getattr(brdf, name) for name in names}
    file = getattr(getattr(f, "__code__", None), "co_filename", "")
    namespace = {"__doc__": brdf.__doc__, "__file__": file, **inside, "f": f}
    if isinstance(p, tuple) and "Params" not in namespace:
        namespace["Params"] = type(p)
    return contract.build(getattr(brdf, "__name__", type(brdf).__name__), namespace)


def parameters_of(model: Model, p: Parameters) -> Any:
    """A parameter set, checked, or None.

    model: whose. p: by name, as a dictionary or a NamedTuple. Raises UserError for a bad value.
    """
    if p is None:
        return None
    named = p if isinstance(p, Mapping) else p._asdict()  # type: ignore[attr-defined]
    return model.parameters(**named)
