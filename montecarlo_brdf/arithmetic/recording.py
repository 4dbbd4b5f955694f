"""Doubles that record: a tape of every place where a model's code may turn another way.

A place is a comparison, `max` or `min` (what decides is the difference of the two), `abs` (its
argument), a division (its divisor), a root, logarithm, arc or whole part (the distance to the edge
of its domain). What decides is its margin: the code turns, or fails, where that passes 0.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import CodeType
from typing import Any, NamedTuple

import numpy as np

from montecarlo_brdf.arithmetic.batch import Widened
from montecarlo_brdf.arithmetic.types import Arithmetic, Array, precision

HERE = str(Path(__file__).parent)
OFTEN = 4  # times that a place comes by in a loop and is told apart
#: what decides, of the operands of an operation
MARGINS: dict[str, Callable[..., Any]] = {
    **dict.fromkeys(
        ("less", "less_equal", "greater", "greater_equal", "equal", "not_equal"), np.subtract
    ),
    **dict.fromkeys(("true_divide", "floor_divide", "remainder"), lambda a, b: b),
    **dict.fromkeys(("sqrt", "log", "log2", "log10", "absolute"), lambda x: x),
    "log1p": lambda x: 1.0 + x,
    **dict.fromkeys(("arccos", "arcsin"), lambda x: 1.0 - np.abs(x)),
    **dict.fromkeys(("floor", "ceil", "trunc", "rint"), lambda x: x - np.rint(x)),
}


class Site(NamedTuple):
    """A place in the code: equal ones are the same."""

    code: CodeType
    position: tuple[int | None, ...]  # lines and columns
    operation: str
    time: int  # of those that it came by in one run

    @property
    def text(self) -> str:
        """In words, for findings."""
        return f"line {self.position[0]} of {self.code.co_name}"


class Tape:
    """The margins of all sites at the points of one call; NaN where a point does not come by."""

    def __init__(self, most: int) -> None:
        self.left = most  # operations until it gives up
        self.margins: dict[Site, Array] = {}
        self._points = 0
        self._part: Array = np.arange(0)
        self._seen: dict[tuple[CodeType, int, str], int] = {}

    def begin(self, points: int) -> None:
        """A call for so many points follows."""
        self._points, self.margins = points, {}

    def watch(self, part: Array) -> None:
        """A run for some of them follows."""
        if self.left < 0:
            raise Widened("it takes too many operations to be followed")
        self._part, self._seen = part, {}

    def note(self, operation: str, margin: Any) -> None:
        """A site came by."""
        self.left -= 1
        if not np.ndim(margin):
            return
        frame = sys._getframe(2)
        while frame.f_code.co_filename.startswith(HERE) and frame.f_back:
            frame = frame.f_back
        key = frame.f_code, frame.f_lasti, operation
        time = self._seen[key] = self._seen.get(key, -1) + 1
        place = _positions(frame.f_code)[frame.f_lasti // 2]
        site = Site(frame.f_code, place, operation, min(time, OFTEN - 1))
        kept = self.margins.setdefault(site, np.full(self._points, np.nan))
        if time >= OFTEN:  # the nearest of all later times
            old = kept[self._part]
            margin = np.where(np.abs(margin) < np.abs(old), margin, old)
        kept[self._part] = margin


_known: dict[CodeType, list[tuple[int | None, ...]]] = {}


def _positions(code: CodeType) -> list[tuple[int | None, ...]]:
    """Where each instruction stands: unlike its place in the code this never changes when the
    interpreter specialises one."""
    if code not in _known:
        _known[code] = list(code.co_positions())
    return _known[code]


def recording(tape: Tape) -> Arithmetic:
    """Doubles whose operations are on a tape."""

    def noting(name: str, decides: Callable[..., Any]) -> Callable[..., Any]:
        operation = getattr(np, name)

        def function(*operands: Any) -> Any:
            tape.note(name, decides(*operands))
            return operation(*operands)

        return function

    plain = precision("float64")
    functions = {name: noting(name, decides) for name, decides in MARGINS.items()}
    return Arithmetic(
        "double precision", plain.dtype, plain.eps, plain.tiny, plain.least, plain.most,
        plain.tolerance, functions, watch=tape.watch,
    )  # fmt: skip
