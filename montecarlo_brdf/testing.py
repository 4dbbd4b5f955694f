"""Assertions about BRDFs for a test suite: each raises AssertionError with finding and cause.

    from montecarlo_brdf.testing import assert_conserves_energy

    def test_energy():
        assert_conserves_energy(my_module, p={"alpha": 0.2})

A BRDF is given as a model, a built-in name, a path, a function f(wo, wi, p), or anything with an
attribute f: a module, a class. `p` is a parameter set: a dictionary, a NamedTuple, or None for the
defaults, around which the worst-case searches then look at the whole ranges. The other options are
those of `verify.run`; every assertion returns its report. An undecided claim is no proof and raises
too, unless inconclusive="pass".
"""
from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from montecarlo_brdf import loading
from montecarlo_brdf.errors import UserError
from montecarlo_brdf.judge.finding import Report
from montecarlo_brdf.model import Model
from montecarlo_brdf.model_file import build
from montecarlo_brdf.report.sentences import case, failures
from montecarlo_brdf.verify.run import run
from montecarlo_brdf.verify.supervision import Deadline

__all__ = [
    "assert_checks",
    "assert_conserves_energy",
    "assert_converges",
    "assert_furnace",
    "assert_reciprocal",
    "assert_samples_match_pdf",
]


def assert_conserves_energy(brdf: Any, p: Any = None, **options: Any) -> Report:
    """Nowhere is more reflected than received, in either direction."""
    __tracebackhide__ = True
    return assert_checks(brdf, p, ("energy",), **options)


def assert_reciprocal(brdf: Any, p: Any = None, **options: Any) -> Report:
    """f(wo, wi) = f(wi, wo)."""
    __tracebackhide__ = True
    return assert_checks(brdf, p, ("reciprocity",), **options)


def assert_furnace(
    brdf: Any, p: Any = None, expected: float | Callable[..., float] | None = None, **options: Any
) -> Report:
    """The albedo is at most 1 and what it should be: `expected`, a number or a function of
    (cos_theta_o, p), or else the model's own reference."""
    __tracebackhide__ = True
    model = as_model(brdf, p)
    if expected is not None:
        albedo = expected if callable(expected) else lambda cos_theta_o, p: expected
        model = dataclasses.replace(model, albedo=albedo)
    return assert_checks(model, p, ("furnace",), **options)


def assert_samples_match_pdf(brdf: Any, p: Any = None, **options: Any) -> Report:
    """Drawn directions follow pdf, which integrates to 1 less what is rejected."""
    __tracebackhide__ = True
    model = as_model(brdf, p)
    if model.sample is None or model.pdf is None:
        raise UserError(f"model {model.name} has no sample and pdf to hold against each other")
    return assert_checks(model, p, ("pdf", "sampling"), **options)


def assert_converges(brdf: Any, p: Any = None, **options: Any) -> Report:
    """The error of every estimator falls with the number of samples as its point set promises;
    options are those of `verify.converge`, and inconclusive."""
    from montecarlo_brdf.verify.converge import converge

    __tracebackhide__ = True
    model = as_model(brdf, p)
    inconclusive = options.pop("inconclusive", "fail")
    report = converge(model, parameters_of(model, p), **options)
    require(report, inconclusive, reproducible=_loadable(model))
    return report


def assert_checks(
    brdf: Any,
    p: Any = None,
    checks: tuple[str, ...] | None = None,
    *,
    inconclusive: str = "fail",
    max_time: float = math.inf,
    **options: Any,
) -> Report:
    """Several checks at once, or all of them."""
    __tracebackhide__ = True
    model = as_model(brdf, p)
    given = parameters_of(model, p)
    deadline = Deadline(max_time)
    report = run(model, given, names=checks, deadline=deadline, **options)
    if report.measured["interrupted"]:
        raise KeyboardInterrupt
    require(report, inconclusive, reproducible=_loadable(model))
    return report


def require(report: Report, inconclusive: str = "fail", reproducible: bool = True) -> None:
    """Raise AssertionError unless every claim of a report held."""
    __tracebackhide__ = True
    bad = ("error", "fail") if inconclusive == "pass" else ("error", "fail", "inconclusive")
    lines = failures(report, bad, reproducible)
    if lines:
        cases = ", ".join(dict.fromkeys(case(r) for r in report.results))
        raise AssertionError("\n".join([f"{cases}: {report.verdict}", *lines]))


def _loadable(model: Model) -> bool:
    """Whether a command line can name the model."""
    return model.built_in or bool(model.terms) or ".py" in model.name


def as_model(brdf: Any, p: Any = None) -> Model:
    """The model that something stands for."""
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
    return build(getattr(brdf, "__name__", type(brdf).__name__), namespace, {}, built_in=False)


def parameters_of(model: Model, p: Any) -> Any:
    """A parameter set, checked, or None."""
    if p is None:
        return None
    return model.parameters(**(p if isinstance(p, Mapping) else p._asdict()))
