"""Every argument of the public API is explained, and so is what it raises."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import montecarlo_brdf
from montecarlo_brdf import testing
from montecarlo_brdf.verify.compare import compare
from montecarlo_brdf.verify.converge import converge
from montecarlo_brdf.verify.furnace import partial_sums


def public() -> Iterator[Callable[..., Any]]:
    """All functions that a user may call, and the methods of the classes that they give."""
    offered = [getattr(montecarlo_brdf, n) for n in montecarlo_brdf.__all__ if n != "__version__"]
    yield from (f for f in offered if inspect.isfunction(f))
    yield from (
        f
        for name, f in vars(montecarlo_brdf.Model).items()
        if inspect.isfunction(f) and not name.startswith("_")
    )
    yield from (f for n, f in vars(testing).items() if n in testing.__all__)
    yield from (testing.require, testing.as_model, testing.parameters_of)
    yield from (compare, converge, partial_sums)


FUNCTIONS = list(public())


def explained(doc: str) -> set[str]:
    """The names that a docstring explains: all of `theta_o_deg, phi_o_deg: ...`."""
    lists = re.findall(r"(?:^|(?<=[\s.]))((?:\w+,\s+)*\w+):\s", doc)
    return {name for names in lists for name in re.split(r",\s+", names)}


def test_what_counts_as_an_explanation() -> None:
    doc = "An area.\n\n    width, height: in metres. unit: its name; None for\n    metres."
    assert explained(doc) == {"width", "height", "unit"}


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.__qualname__)
def test_every_argument_is_explained(function: Callable[..., Any]) -> None:
    doc = inspect.getdoc(function) or ""
    arguments = [n for n in inspect.signature(function).parameters if n != "self"]
    assert [n for n in arguments if n not in explained(doc)] == []


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.__qualname__)
def test_what_is_raised_is_told(function: Callable[..., Any]) -> None:
    assert re.search(r"\bRaises \w+", inspect.getdoc(function) or "")
