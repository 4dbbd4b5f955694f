"""What stands in a kernel for the plain functions on words: machine instructions."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.bits import (
    ROUNDER,
    ROUNDER_WORD,
    double_at,
    double_of,
    number_of,
    reverse32,
    smaller,
    u32,
    u64,
    word_of,
)

if TYPE_CHECKING:
    from llvmlite.ir import IRBuilder as Builder
    from llvmlite.ir import Value
    from numba.core.base import BaseContext as Context
    from numba.core.types import Type
    from numba.core.typing.context import Context as Typing
    from numba.core.typing.templates import Signature

    Args = Sequence[Value]


def compiled_twins() -> dict[Callable[..., Any], Any]:
    """From a function of `bits` to its instruction."""
    import llvmlite.ir as ir
    import numba
    from numba.extending import intrinsic

    @intrinsic
    def reverse(typing: Typing, x: Type) -> Any:
        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            word = ir.IntType(32)
            return builder.call(builder.module.declare_intrinsic("llvm.bitreverse", [word]), args)

        return numba.uint32(numba.uint32), generate

    @intrinsic
    def double(typing: Typing, x: Type) -> Any:
        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            return builder.bitcast(args[0], ir.DoubleType())

        return numba.float64(numba.int64), generate

    @intrinsic
    def number(typing: Typing, x: Type) -> Any:
        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            shifted = builder.add(args[0], ir.Constant(ir.IntType(64), ROUNDER_WORD))
            moved = builder.bitcast(shifted, ir.DoubleType())
            back = ir.Constant(ir.DoubleType(), ROUNDER)
            # numba marks as reassociable what has no flag at all; this one allows nothing here
            return builder.fsub(moved, back, flags=("arcp",))

        return numba.float64(numba.int64), generate

    @intrinsic
    def word(typing: Typing, x: Type) -> Any:
        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            return builder.bitcast(args[0], ir.IntType(64))

        return numba.int64(numba.float64), generate

    @intrinsic
    def minimum(typing: Typing, a: Type, b: Type) -> Any:
        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            below = builder.fcmp_ordered("<", *args, flags=("nnan", "nsz"))
            return builder.select(below, *args, flags=("nnan", "nsz"))

        return numba.float64(numba.float64, numba.float64), generate

    @intrinsic
    def load(typing: Typing, address: Type, index: Type) -> Any:
        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            whole = builder.fptosi(args[0], ir.IntType(64))
            first = builder.inttoptr(whole, ir.DoubleType().as_pointer())
            return builder.load(builder.gep(first, [args[1]]))

        return numba.float64(numba.float64, numba.int64), generate

    return {
        double_at: load,
        smaller: minimum,
        u64: numba.uint64,
        u32: numba.uint32,
        reverse32: reverse,
        number_of: number,
        word_of: word,
        double_of: double,
    }
