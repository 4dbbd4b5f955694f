"""Which lines of a model no check runs, not even by the search for its branches.

Compiled code leaves no trace: the plain functions are called at a share of the points that all laws
are asked at, until every line was run. Lines that only directions below the horizon run guard
against what nobody asks, and are not told.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from types import CodeType, FrameType, FunctionType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from montecarlo_brdf.cases.code import functions_of, source_lines
from montecarlo_brdf.cases.look import Look
from montecarlo_brdf.compile.bind import plain
from montecarlo_brdf.model import Model

if TYPE_CHECKING:
    from montecarlo_brdf.cases.directions import Array, Index

CALLS = 2000  # of each function at most, half of them where the code turns
SETS = 64  # parameter sets among them that are prepared
Left = dict[CodeType, set[int]]


class Unrun(NamedTuple):
    """Lines of a function that were not run."""

    file: str
    function: str
    lines: tuple[int, ...]


def unrun(at: Look) -> list[Unrun]:
    """The lines that were not run; none if all were."""
    functions = [f for f in functions_of(at.model) if _has_source(f)]
    left: Left = {f.__code__: source_lines(f) for f in functions}
    index = _some(at)
    _call_all(at, index, left, np.array([1.0, 1.0, 1.0]))
    if any(left.values()):
        _call_all(at, index[: CALLS // 8], left, np.array([1.0, 1.0, -1.0]))
    found = [Unrun(c.co_filename, c.co_name, tuple(sorted(n))) for c, n in left.items() if n]
    return sorted(found, key=lambda one: one.lines)


def total(model: Model) -> int:
    """How many lines a model has."""
    return sum(len(source_lines(f)) for f in functions_of(model) if _has_source(f))


def _has_source(function: Any) -> bool:
    """Whether lines of a function are lines of a file that its author wrote."""
    return isinstance(function, FunctionType) and function.__code__.co_filename.endswith(".py")


def _some(at: Look) -> Index:
    """Points where the code turns and such as are everywhere, at most CALLS."""
    turns = np.flatnonzero(at.points.label)
    rest = np.flatnonzero(at.points.label == 0)
    rng = at.case.random("lines")
    some = rng.permutation(turns)[: CALLS // 2]
    index = np.concatenate([rng.permutation(rest)[: CALLS - len(some)], some])
    return rng.permutation(index)


def _call_all(at: Look, index: Index, left: Left, side: Array) -> None:
    """Every function at some points, until no line is left; side: to which both directions are
    turned, one after the other."""
    calls = list(_calls(at.model, at))

    def trace(frame: FrameType, event: str, argument: Any) -> Any:
        return line if left.get(frame.f_code) else None

    def line(frame: FrameType, event: str, argument: Any) -> Any:
        if event == "line":
            left[frame.f_code].discard(frame.f_lineno)
        return line

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        for k in index:
            if not any(left.values()):
                return
            for call in calls:
                _quietly(call, int(k), side)
    finally:
        sys.settrace(before)


def _quietly(call: Callable[[int, Array], None], k: int, side: Array) -> None:
    try:
        call(k, side)
    except Exception:  # what Python raises, compiled arithmetic does not
        return


def _calls(model: Model, at: Look) -> Iterator[Callable[[int, Array], None]]:
    """The functions of a model, called at a point."""
    points, ready = at.points, _ready(model, at)
    f, pdf, sample = (plain(g) for g in (model.f, model.pdf, model.sample))

    def pair(k: int, side: Array) -> tuple[Any, Any]:
        return tuple((points.wo[k] * side).tolist()), tuple((points.wi[k] * side).tolist())

    def of_pair(function: Callable[..., Any], k: int, side: Array) -> None:
        wo, wi = pair(k, side)
        p = ready(k)
        function(wo, wi, p)
        if side[2] < 0.0:  # then each of them alone
            up = tuple(points.wo[k].tolist()), tuple(points.wi[k].tolist())
            function(up[0], wi, p)
            function(wo, up[1], p)

    yield lambda k, side: of_pair(f, k, side)
    if pdf is not None:
        yield lambda k, side: of_pair(pdf, k, side)
    if sample is not None:
        yield lambda k, side: sample(pair(k, side)[0], tuple(points.u[k].tolist()), ready(k))
    if model.albedo is not None:
        known = plain(model.albedo)
        yield lambda k, side: known(float(points.wo[k, 2]), at.parameters(k))


def _ready(model: Model, at: Look) -> Callable[[int], Any]:
    """What the functions get at a point; some sets stand for the others where they are prepared."""
    if model.prepare is None:
        return at.parameters
    made: dict[int, Any] = {}

    def ready(k: int) -> Any:
        place = k % SETS if len(made) >= SETS else k
        if place not in made:
            place = k if len(made) < SETS else next(iter(made))
            made.setdefault(place, plain(model.prepare)(at.parameters(k)))
        return made[place]

    return ready
