"""Parameters as a flat row of doubles, and the way back to NamedTuples inside a kernel.

K parameter sets (the channels of a colour) share the places of the numbers they have in common:
the compiler then sees the same value once and computes what depends on it once.
"""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple


class Layout(NamedTuple):
    """Where each field of each channel stands; equal layouts share a kernel."""

    kind: type
    widths: tuple[int, ...]  # per field: 0 for a number, n for a tuple of n numbers
    places: tuple[tuple[int, ...], ...]  # per channel: the place of every number

    def key(self) -> tuple[Any, ...]:
        """What the compiled code depends on: names and places, never values."""
        return self.kind.__name__, getattr(self.kind, "_fields", ()), self.widths, self.places


def flatten(p: Any) -> tuple[tuple[int, ...], list[float]]:
    """(widths, numbers) of a NamedTuple whose fields are numbers or tuples of numbers."""
    widths, numbers = [], []
    for value in p:
        if isinstance(value, (int, float)):
            widths.append(0)
            numbers.append(float(value))
        else:
            row = [float(v) for v in value]
            widths.append(len(row))
            numbers.extend(row)
    return tuple(widths), numbers


def pack(channels: Sequence[Any], first: int) -> tuple[Layout, list[float]]:
    """Layout and numbers of K parameter sets, the numbers starting at place `first`."""
    rows = [flatten(p) for p in channels]
    widths = rows[0][0]
    numbers: list[float] = []
    places: list[list[int]] = [[] for _ in rows]
    for column in zip(*(row[1] for row in rows)):
        shared = len(set(column)) == 1
        for k, value in enumerate(column):
            if k == 0 or not shared:
                numbers.append(value)
            places[k].append(first + len(numbers) - 1)
    return Layout(type(channels[0]), widths, tuple(map(tuple, places))), numbers


def unpacker(layout: Layout) -> Any:
    """Intrinsic `unpack(reals)`: the K NamedTuples of a layout."""
    import numba
    from numba.extending import intrinsic

    def field_type(width: int) -> Any:
        return numba.types.UniTuple(numba.float64, width) if width else numba.float64

    fields = [field_type(w) for w in layout.widths]
    uniform = bool(fields) and all(t == fields[0] for t in fields)
    one = (
        numba.types.NamedUniTuple(fields[0], len(fields), layout.kind)
        if uniform
        else numba.types.NamedTuple(fields, layout.kind)
    )

    @intrinsic
    def unpack(typing: Any, reals: Any) -> Any:
        result = numba.types.UniTuple(one, len(layout.places))

        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            def number(place: int) -> Any:
                index = context.get_constant(numba.types.intp, place)
                return builder.load(builder.gep(args[0], [index]))

            def fields_of(places: tuple[int, ...]) -> Any:
                rest = iter(places)
                for kind, width in zip(fields, layout.widths):
                    if width:
                        yield context.make_tuple(builder, kind, [number(next(rest)) for _ in range(width)])
                    else:
                        yield number(next(rest))

            tuples = [context.make_tuple(builder, one, list(fields_of(c))) for c in layout.places]
            return context.make_tuple(builder, result, tuples)

        return result(reals), generate

    return unpack
