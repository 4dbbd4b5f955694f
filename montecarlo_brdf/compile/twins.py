"""What stands in a kernel for the plain functions on words: machine instructions."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

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


def compiled_twins() -> dict[Callable[..., Any], Any]:
    """From a function of `bits` to its instruction."""
    import llvmlite.ir as ir
    import numba
    from numba.extending import intrinsic

    @intrinsic
    def reverse(typing: Any, x: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            word = ir.IntType(32)
            return builder.call(builder.module.declare_intrinsic("llvm.bitreverse", [word]), args)

        return numba.uint32(numba.uint32), generate

    @intrinsic
    def double(typing: Any, x: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return builder.bitcast(args[0], ir.DoubleType())

        return numba.float64(numba.int64), generate

    @intrinsic
    def number(typing: Any, x: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            shifted = builder.add(args[0], ir.Constant(ir.IntType(64), ROUNDER_WORD))
            moved = builder.bitcast(shifted, ir.DoubleType())
            back = ir.Constant(ir.DoubleType(), ROUNDER)
            # numba marks as reassociable what has no flag at all; this one allows nothing here
            return builder.fsub(moved, back, flags=("arcp",))

        return numba.float64(numba.int64), generate

    @intrinsic
    def word(typing: Any, x: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return builder.bitcast(args[0], ir.IntType(64))

        return numba.int64(numba.float64), generate

    @intrinsic
    def minimum(typing: Any, a: Any, b: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            below = builder.fcmp_ordered("<", *args, flags=("nnan", "nsz"))
            return builder.select(below, *args, flags=("nnan", "nsz"))

        return numba.float64(numba.float64, numba.float64), generate

    @intrinsic
    def load(typing: Any, address: Any, index: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
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
