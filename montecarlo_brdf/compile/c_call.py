"""Functions of C within models: called by their address in plain Python, in a kernel by their
address or, where their LLVM code is known, linked and inlined.

    double f(const double *wo, const double *wi, const double *p)
    void sample(const double *wo, const double *u, const double *p, double *wi)
"""

from __future__ import annotations

import ctypes
import functools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.compile import native
from montecarlo_brdf.compile.bind import Instruction

if TYPE_CHECKING:
    from collections.abc import Sequence

    from llvmlite.ir import IRBuilder as Builder
    from llvmlite.ir import Value
    from numba.core.base import BaseContext as Context
    from numba.core.types import Type
    from numba.core.typing.context import Context as Typing
    from numba.core.typing.templates import Signature

    Args = Sequence[Value]

VECTORS = 6  # numbers of both vectors, before the parameters
RESULTS = 3
_DOUBLES = ctypes.POINTER(ctypes.c_double)
_VALUE = ctypes.CFUNCTYPE(ctypes.c_double, *[_DOUBLES] * 3)
_DRAW = ctypes.CFUNCTYPE(None, *[_DOUBLES] * 4)


@dataclass(frozen=True)
class Call(Instruction):
    """`call(address, numbers)`: three numbers, of which a function that gives one fills the first.

    numbers: both vectors, then the parameters. content: hash of all that the function is made of.
    code: LLVM's text of it, where there is one; the address is then not looked at in a kernel.
    """

    symbol: str
    content: str
    inputs: int
    draws: bool
    code: str = field(default="", compare=False, repr=False)
    find: Callable[[], int] = field(default=int, compare=False, repr=False)  # its address

    def key(self) -> object:
        """The name and what stands behind it."""
        return self.symbol, self.content, self.inputs, self.draws, bool(self.code)

    def __call__(self, address: float, numbers: Sequence[float]) -> tuple[float, ...]:
        row = (ctypes.c_double * (self.inputs + RESULTS))(*numbers)
        places = (0, 3, VECTORS, self.inputs)
        pointers = [ctypes.cast(ctypes.byref(row, 8 * k), _DOUBLES) for k in places]
        if self.draws:
            _DRAW(self.find())(*pointers)
        else:
            row[self.inputs] = _VALUE(self.find())(*pointers[:3])
        return tuple(row[self.inputs :])

    def intrinsic(self) -> Any:
        """A row of numbers on the stack, and a call with pointers into it."""
        import llvmlite.ir as ir
        import numba
        from numba.core import cgutils
        from numba.extending import intrinsic

        one, inputs = self, self.inputs
        double, result = ir.DoubleType(), numba.types.UniTuple(numba.float64, RESULTS)
        pointer = double.as_pointer()
        gives = ir.VoidType() if self.draws else double
        form = ir.FunctionType(gives, [pointer] * (3 + self.draws))

        def function(context: Any, builder: Builder, address: Value) -> Value:
            if not one.code:
                whole = builder.fptosi(address, ir.IntType(64))
                return builder.inttoptr(whole, form.as_pointer())
            context.active_code_library._linking_libraries.append(_linkable(one.content, one.code))
            return cgutils.get_or_insert_function(builder.module, form, one.symbol)

        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            row = cgutils.alloca_once(builder, double, size=inputs + RESULTS)
            places = [builder.gep(row, [ir.IntType(64)(k)]) for k in range(inputs + RESULTS)]
            given = cgutils.unpack_tuple(builder, args[1], inputs)
            for place, value in zip(places, [*given, *[double(0.0)] * RESULTS], strict=True):
                builder.store(value, place)
            pointers = [places[k] for k in (0, 3, VECTORS, inputs)][: len(form.args)]
            value = builder.call(function(context, builder, args[0]), pointers)
            if not one.draws:
                builder.store(value, places[inputs])
            found = [builder.load(place) for place in places[inputs:]]
            return context.make_tuple(builder, result, found)

        @intrinsic
        def call(typing: Typing, address: Type, numbers: Type) -> Any:
            numbers = numba.types.UniTuple(numba.float64, inputs)
            return result(numba.float64, numbers), generate

        return call


class _Linkable:
    """LLVM code as numba's libraries give it to be linked."""

    def __init__(self, code: str) -> None:
        self._code = code

    def _get_module_for_linking(self) -> Any:
        return native.parsed(self._code)


@functools.lru_cache(maxsize=64)
def _linkable(content: str, code: str) -> _Linkable:
    """One for all functions of a file: it is linked once."""
    return _Linkable(code)


@functools.lru_cache(maxsize=64)
def engine(code: str) -> Any:
    """LLVM code as machine code of this process, whose functions have addresses."""
    import llvmlite.binding as binding

    made = binding.create_mcjit_compiler(native.parsed(code), native.machine())
    made.finalize_object()
    return made
