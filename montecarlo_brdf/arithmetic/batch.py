"""Arrays that behave like numbers, so that a function of numbers runs on thousands of points.

A branch on an array has no single answer. `Mixed` carries the answers, `over_points` divides the
points by them and runs the function again on each part: every `if`, `max` and `while` of a model
means what it means for one number. And it is a trace of types: an operation whose result would be
of another float type raises `Widened`, so that single precision is single from start to end.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from montecarlo_brdf.arithmetic.types import Arithmetic, Array

MOST_PARTS = 20_000
LOWEST_INTEGER = -(1 << 63)  # what a processor gives for the integer of NaN


class Mixed(Exception):  # noqa: N818  a question with several answers, not an error
    """The points do not agree on a condition."""

    def __init__(self, answers: Array) -> None:
        super().__init__()
        self.answers = answers


class Widened(TypeError):
    """A result was of another type than its operands."""


def agreed(answers: Array) -> Any:
    """The answer all points agree on; otherwise Mixed."""
    answers = np.asarray(answers)
    first = answers.flat[0]
    if np.all(answers == first):
        return first
    raise Mixed(answers)


class Batch:
    """Many numbers of one type."""

    __slots__ = ("values", "arithmetic")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, values: Array | None, arithmetic: Arithmetic) -> None:
        self.values: Any = values  # None: only the type
        self.arithmetic = arithmetic

    def apply(self, name: str, *operands: object) -> Any:
        """The operation `name` of this type; conditions come back as a Mask."""
        result = np.asarray(self.arithmetic.function(name)(*map(self._operand, operands)))
        if result.dtype == self.arithmetic.dtype:
            return Batch(result, self.arithmetic)
        if result.dtype == bool:
            return Mask(result)
        raise Widened(f"{name} of {self.arithmetic} gave {result.dtype}")

    def _operand(self, other: object) -> Any:
        if isinstance(other, Batch):
            if other.arithmetic is not self.arithmetic:
                raise Widened(f"{self.arithmetic} meets {other.arithmetic}")
            return other.values
        if type(other) is float:  # constants, by far the most of the rest
            return self.arithmetic.number(other)
        if isinstance(other, np.ndarray) and other.dtype == object != self.arithmetic.dtype:
            raise Widened("it puts numbers into an array, where no precision can be followed")
        if isinstance(other, np.ndarray | np.floating) and other.dtype != self.arithmetic.dtype:
            raise Widened(f"{self.arithmetic} meets an array of {other.dtype}")
        if isinstance(other, Whole):
            other = other.values
        return self.arithmetic.array(other)  # type: ignore[arg-type]

    def __array_ufunc__(
        self, ufunc: np.ufunc, method: str, *operands: object, **options: object
    ) -> Any:
        return self.apply(ufunc.__name__, *operands) if method == "__call__" else NotImplemented

    def __int__(self) -> int:
        with np.errstate(all="ignore"):
            inside = np.abs(self.values) < 2.0**63
            whole = np.where(inside, self.values, 0).astype(np.int64)
        return int(agreed(np.where(inside, whole, LOWEST_INTEGER)))

    __index__ = __int__  # a place in a table is asked for like a condition
    __trunc__ = __int__

    def __bool__(self) -> bool:
        return bool(agreed(self.values != 0))

    def __float__(self) -> float:
        raise Widened(f"float() of {self.arithmetic} is a double")

    def __round__(self, digits: int | None = None) -> Any:
        return self.apply("rint", self)


def _define(cls: type, method: str, name: str, reverse: bool = False, unary: bool = False) -> None:
    """Let the operator `method` of `cls` be the operation `name`."""

    def one(self: Any) -> Any:
        return self.apply(name, self)

    def two(self: Any, other: object) -> Any:
        return self.apply(name, other, self) if reverse else self.apply(name, self, other)

    setattr(cls, f"__{method}__", one if unary else two)


BINARY = {"add": "add", "sub": "subtract", "mul": "multiply", "truediv": "true_divide",
          "pow": "power", "mod": "remainder", "floordiv": "floor_divide"}  # fmt: skip
COMPARISONS = {"lt": "less", "le": "less_equal", "gt": "greater", "ge": "greater_equal",
               "eq": "equal", "ne": "not_equal"}  # fmt: skip

for _method, _name in BINARY.items():
    _define(Batch, _method, _name)
    _define(Batch, f"r{_method}", _name, reverse=True)
for _method, _name in COMPARISONS.items():
    _define(Batch, _method, _name)
for _method, _name in {"neg": "negative", "abs": "absolute", "pos": "positive"}.items():
    _define(Batch, _method, _name, unary=True)


class Mask:
    """Many conditions."""

    __slots__ = ("values",)

    def __init__(self, values: Array) -> None:
        self.values = values

    def __bool__(self) -> bool:
        return bool(agreed(self.values))

    def __and__(self, other: object) -> Mask:
        return Mask(self.values & getattr(other, "values", other))

    def __or__(self, other: object) -> Mask:
        return Mask(self.values | getattr(other, "values", other))

    def __invert__(self) -> Mask:
        return Mask(~self.values)


class Whole:
    """Many integers of 64 bits: the words of doubles."""

    __slots__ = ("values", "arithmetic")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, values: Array, arithmetic: Arithmetic) -> None:
        self.values = values
        self.arithmetic = arithmetic

    def apply(self, name: str, *operands: object) -> Any:
        """Integer arithmetic with integers; with floats the double that a kernel would make."""
        if any(isinstance(o, Batch | float) for o in operands):
            return Batch(None, self.arithmetic).apply(name, *operands)
        result = getattr(np, name)(*(np.asarray(getattr(o, "values", o)) for o in operands))
        return Mask(result) if result.dtype == bool else Whole(result, self.arithmetic)


for _method, _name in {**BINARY, "and": "bitwise_and", "or": "bitwise_or", "lshift": "left_shift",
                       "rshift": "right_shift"}.items():  # fmt: skip
    _define(Whole, _method, _name)
    _define(Whole, f"r{_method}", _name, reverse=True)
for _method, _name in COMPARISONS.items():
    _define(Whole, _method, _name)


class Table:
    """A read-only table whose entries are numbers of one precision."""

    def __init__(self, values: Array, arithmetic: Arithmetic) -> None:
        self.values, self.arithmetic = values, arithmetic
        self.shape = np.shape(values)

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, place: Any) -> Any:
        found = self.values[place]
        return Table(found, self.arithmetic) if np.ndim(found) else Batch(found, self.arithmetic)


def over_points(columns: Sequence[Any], call: Callable[..., Any], arithmetic: Arithmetic) -> Any:
    """call(*batches) at every point, as an array (numbers per result, points).

    columns: arrays of one length, or single numbers that all points share.
    """
    count = max((np.size(c) for c in columns if np.ndim(c)), default=1)
    out: Any = None
    parts = [np.arange(count)]
    done = 0
    while parts:
        part = parts.pop()
        done += 1
        if done > MOST_PARTS:
            raise Widened(f"the function takes more than {MOST_PARTS} different paths")
        if arithmetic.watch:
            arithmetic.watch(part)
        try:
            with np.errstate(all="ignore"):
                batches = [Batch(c[part] if np.ndim(c) else c, arithmetic) for c in columns]
                result = call(*batches)
        except Mixed as mixed:
            answers = np.broadcast_to(mixed.answers, part.shape)
            parts += [part[answers == a] for a in np.unique(answers)]
            continue
        rows = result if isinstance(result, tuple | list) else (result,)
        if out is None:
            out = np.empty((len(rows), count), dtype=arithmetic.dtype)
        for k, row in enumerate(rows):
            out[k, part] = row.values if isinstance(row, Batch) else arithmetic.array(row)
    return out
