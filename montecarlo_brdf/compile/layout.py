"""Parameters as a flat row of doubles, and the way back to NamedTuples inside a kernel.

K parameter sets (the channels of a colour) share the places of the numbers they have in common:
the compiler then sees the same value once and computes what depends on it once.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from montecarlo_brdf.compile.bind import Instruction

if TYPE_CHECKING:
    from llvmlite.ir import IRBuilder as Builder
    from llvmlite.ir import Value
    from numba.core.base import BaseContext as Context
    from numba.core.types import Type
    from numba.core.typing.context import Context as Typing
    from numba.core.typing.templates import Signature

    Args = Sequence[Value]

    from numpy.typing import NDArray

#: The last argument of a model's functions: a number, an array of numbers, or a tuple of such, as
#: a NamedTuple.
Numbers: TypeAlias = "float | NDArray[Any] | tuple[Numbers, ...]"
#: numbers of a plain tuple from which on it is looked up as an array is: else every single one of
#: them would be code
LONG = 64


DOUBLE = 8  # bytes


class Grid(NamedTuple):
    """The shape of an array."""

    sides: tuple[int, ...]

    @property
    def size(self) -> int:
        """How many numbers it has."""
        return math.prod(self.sides)


#: None for a number, a Grid for an array, (type, shapes of the fields) for a tuple.
Shape = Grid | tuple[type, tuple["Shape", ...]] | None


class Layout(NamedTuple):
    """Where each number of each channel stands; equal layouts share a kernel."""

    shape: Shape
    places: tuple[tuple[int, ...], ...]  # per channel: the place of every number

    def key(self) -> tuple[Any, ...]:
        """What the compiled code depends on: names and places, never values."""
        return _described(self.shape), self.places


def shape_of(value: Any) -> Shape:
    """None for a number, a Grid for an array, (type, shapes of the fields) for a NamedTuple or
    tuple."""
    if _is_long(value):
        return Grid((len(value),))
    if isinstance(value, tuple):
        return type(value), tuple(shape_of(v) for v in value)
    if sides := getattr(value, "shape", ()):
        return Grid(tuple(sides))
    float(value)
    return None


def _is_long(value: Any) -> bool:
    """Whether it is a plain tuple of many numbers."""
    return type(value) is tuple and len(value) > LONG and set(map(type, value)) <= {float, int}


def numbers_of(value: Numbers) -> Iterator[float]:
    """All numbers of a nested tuple in order."""
    return itertools.chain.from_iterable(_leaves(value))


def _leaves(value: Any) -> Iterator[Sequence[float]]:
    """Numbers that must stand side by side: all of an array, each of another one alone."""
    if _is_long(value):
        yield tuple(map(float, value))
    elif isinstance(value, tuple):
        for field in value:
            yield from _leaves(field)
    elif getattr(value, "shape", ()):
        yield tuple(map(float, value.ravel()))
    else:
        yield (float(value),)


def _described(shape: Shape) -> object:
    if shape is None or isinstance(shape, Grid):
        return shape and shape.sides
    kind, fields = shape
    return kind.__name__, getattr(kind, "_fields", ()), tuple(map(_described, fields))


def pack(channels: Sequence[Numbers], first: int) -> tuple[Layout, list[float]]:
    """Layout and numbers of K parameter sets, the numbers starting at place `first`."""
    numbers: list[float] = []
    places: list[list[int]] = [[] for _ in channels]
    for column in zip(*map(_leaves, channels), strict=True):
        shared = len(set(column)) == 1
        for k, leaf in enumerate(column):
            if k == 0 or not shared:
                numbers += leaf
            end = first + len(numbers)
            places[k] += range(end - len(leaf), end)
    return Layout(shape_of(channels[0]), tuple(map(tuple, places))), numbers


def following(shape: Shape, first: int) -> Layout:
    """The layout of one parameter set of a shape whose numbers start at place `first`."""
    return Layout(shape, (tuple(range(first, first + size_of(shape))),))


def size_of(shape: Shape) -> int:
    """How many numbers a value of this shape has."""
    if isinstance(shape, Grid):
        return shape.size
    return 1 if shape is None else sum(map(size_of, shape[1]))


@dataclass(frozen=True)
class Unpack(Instruction):
    """`unpack(reals)`: the K NamedTuples of a layout."""

    layout: Layout

    def key(self) -> object:
        """Names and places."""
        return self.layout.key()

    def intrinsic(self) -> Any:
        """Loads, and tuples made of them."""
        import numba
        from numba.extending import intrinsic

        layout, one = self.layout, _numba_type(self.layout.shape)

        @intrinsic
        def unpack(typing: Typing, reals: Type) -> Any:
            result = numba.types.UniTuple(one, len(layout.places))

            def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
                def number(place: int) -> Value:
                    index = context.get_constant(numba.types.intp, place)
                    return builder.load(builder.gep(args[0], [index]))

                def made(shape: Shape, places: Iterator[int]) -> Value:
                    if shape is None:
                        return number(next(places))
                    if isinstance(shape, Grid):
                        first, *_ = itertools.islice(places, shape.size)
                        return _array(context, builder, args[0], first, shape)
                    fields = [made(s, places) for s in shape[1]]
                    return context.make_tuple(builder, _numba_type(shape), fields)

                tuples = [made(layout.shape, iter(places)) for places in layout.places]
                return context.make_tuple(builder, result, tuples)

            return result(reals), generate

        return unpack


def _array(context: Context, builder: Builder, reals: Value, first: int, grid: Grid) -> Value:
    """An array of the numbers from a place on, without a copy."""
    import numba
    from numba.np import arrayobj

    def constant(k: int) -> Value:
        return context.get_constant(numba.types.intp, k)

    array = arrayobj.make_array(_numba_type(grid))(context, builder)
    data = builder.bitcast(builder.gep(reals, [constant(first)]), array.data.type)
    strides = [DOUBLE * math.prod(grid.sides[k + 1 :]) for k in range(len(grid.sides))]
    arrayobj.populate_array(
        array, data=data, shape=[constant(n) for n in grid.sides],
        strides=[constant(n) for n in strides], itemsize=constant(DOUBLE), meminfo=None,
    )  # fmt: skip
    return array._getvalue()


def _numba_type(shape: Shape) -> Type:
    """The numba type of a shape; a tuple of equal types is a uniform one, as numba would type
    it."""
    import numba

    if shape is None:
        return numba.float64
    if isinstance(shape, Grid):
        return numba.types.Array(numba.float64, len(shape.sides), "C", readonly=True)
    kind, fields = shape[0], [_numba_type(s) for s in shape[1]]
    uniform = bool(fields) and all(t == fields[0] for t in fields)
    if kind is tuple:
        return (
            numba.types.UniTuple(fields[0], len(fields)) if uniform else numba.types.Tuple(fields)
        )
    if uniform:
        return numba.types.NamedUniTuple(fields[0], len(fields), kind)
    return numba.types.NamedTuple(fields, kind)


@dataclass(frozen=True)
class Row(Instruction):
    """`row(reals, k)`: the numbers from place k on."""

    def key(self) -> object:
        """Nothing."""
        return ()

    def intrinsic(self) -> Any:
        """A pointer that is moved."""
        from numba.extending import intrinsic

        @intrinsic
        def row(typing: Typing, reals: Type, k: Type) -> Any:
            def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
                return builder.gep(args[0], [args[1]])

            return reals(reals, k), generate

        return row


@dataclass(frozen=True)
class Buffer(Instruction):
    """`buffer()`: room for `size` doubles on the kernel's stack."""

    size: int

    def key(self) -> object:
        """The size."""
        return self.size

    def intrinsic(self) -> Any:
        """A reservation at the entry of the function."""
        import llvmlite.ir as ir
        import numba
        from numba.core import cgutils
        from numba.extending import intrinsic

        size = self.size

        @intrinsic
        def buffer(typing: Typing) -> Any:
            def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
                room = cgutils.alloca_once(builder, ir.DoubleType(), size=size)
                room.align = 64  # or half of all vectors straddle two lines of the cache
                return room

            return numba.types.CPointer(numba.float64)(), generate

        return buffer
