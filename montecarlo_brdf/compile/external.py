"""What stands in a template for a model: calls of functions that are linked later, and parameters
as rows of numbers that only these functions read. So its code is the same for every model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.compile.bind import Instruction

if TYPE_CHECKING:
    from llvmlite.ir import IRBuilder as Builder
    from llvmlite.ir import Value
    from numba.core.base import BaseContext as Context
    from numba.core.types import Type
    from numba.core.typing.context import Context as Typing
    from numba.core.typing.templates import Signature

    Args = Sequence[Value]

#: the name of a type of numbers, or the kinds of a tuple's fields
Kind = str | tuple["Kind", ...]
NUMBERS = ("float64", "float32", "int64", "int32", "uint64", "uint32", "boolean")


class Unknown(Exception):
    """A type that no template is compiled for."""


def kind_of(given: Any) -> Kind:
    """The kind of a numba type. Raises Unknown for what is no number and no tuple of such."""
    import numba

    if isinstance(given, numba.types.BaseTuple):
        fields: Any = given
        return tuple(map(kind_of, fields.types))
    for name in NUMBERS:
        if given == getattr(numba.types, name):
            return name
    raise Unknown(str(given))


def type_of(kind: Kind) -> Type:
    """The numba type of a kind."""
    import numba

    if isinstance(kind, str):
        found: Type = getattr(numba.types, kind)
        return found
    return numba.types.Tuple([type_of(field) for field in kind])


def argument_types(vectors: int) -> tuple[Type, ...]:
    """Of a model's function where a template calls it: triples of numbers and the parameters."""
    import numba

    triple, numbers = numba.types.UniTuple(numba.float64, 3), numba.types.CPointer(numba.float64)
    return (*[triple] * vectors, numbers)


@dataclass(frozen=True)
class External(Instruction):
    """`external(w, p)` or `external(wo, wi, p)`: a function of a model, linked by its name."""

    symbol: str
    vectors: int
    returns: Kind

    def key(self) -> object:
        """The name and the types."""
        return self.symbol, self.vectors, self.returns

    def intrinsic(self) -> Any:
        """A call by numba's convention, which passes an exception on."""
        from numba.core import cgutils
        from numba.extending import intrinsic

        result, types, symbol = type_of(self.returns), argument_types(self.vectors), self.symbol

        def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
            convention: Any = context.call_conv  # type: ignore[attr-defined]
            form = convention.get_function_type(result, types)
            function = cgutils.get_or_insert_function(builder.module, form, symbol)
            status, value = convention.call_function(builder, function, result, types, args)
            with cgutils.if_unlikely(builder, status.is_error):
                convention.return_status_propagate(builder, status)
            return value

        @intrinsic
        def with_one(typing: Typing, w: Type, p: Type) -> Any:
            return result(*types), generate

        @intrinsic
        def with_two(typing: Typing, a: Type, b: Type, p: Type) -> Any:
            return result(*types), generate

        return {1: with_one, 2: with_two}[self.vectors]


@dataclass(frozen=True)
class Addresses(Instruction):
    """`addresses(reals)`: where the numbers of each of K parameter sets are, copied by a function
    that is linked later. They lie on the stack, from where the compiler takes them to registers."""

    symbol: str
    room: int
    channels: int

    def key(self) -> object:
        """The name and the sizes."""
        return self.symbol, self.room, self.channels

    def intrinsic(self) -> Any:
        """A reservation, a call, and K pointers."""
        import llvmlite.ir as ir
        import numba
        from numba.core import cgutils
        from numba.extending import intrinsic

        symbol, room, channels = self.symbol, self.room, self.channels

        @intrinsic
        def addresses(typing: Typing, reals: Type) -> Any:
            result = numba.types.UniTuple(numba.types.CPointer(numba.float64), channels)

            def generate(context: Context, builder: Builder, kind: Signature, args: Args) -> Value:
                copy = cgutils.get_or_insert_function(builder.module, copier_type(), symbol)
                rows = cgutils.alloca_once(builder, ir.DoubleType(), size=room * channels)
                builder.call(copy, [args[0], rows])
                places = [context.get_constant(numba.types.intp, room * k) for k in range(channels)]
                fields = [builder.gep(rows, [place]) for place in places]
                return context.make_tuple(builder, result, fields)

            return result(reals), generate

        return addresses


def copier_type() -> Any:
    """void copier(from, to)."""
    import llvmlite.ir as ir

    return ir.FunctionType(ir.VoidType(), [ir.DoubleType().as_pointer()] * 2)


def copier(places: Sequence[Sequence[int]], symbol: str, room: int) -> str:
    """The function behind `Addresses` as text of LLVM: the numbers of each set from their places,
    those that sets share loaded once."""
    import llvmlite.ir as ir

    module = ir.Module(name=symbol)
    function = ir.Function(module, copier_type(), symbol)
    function.attributes.add("alwaysinline")
    builder = ir.IRBuilder(function.append_basic_block())
    source, target = function.args

    def at(pointer: Value, place: int) -> Value:
        return builder.gep(pointer, [ir.Constant(ir.IntType(64), place)])

    used = sorted({place for row in places for place in row})
    loaded = {place: builder.load(at(source, place)) for place in used}
    for k, row in enumerate(places):
        for i, place in enumerate(row):
            builder.store(loaded[place], at(target, k * room + i))
    builder.ret_void()
    return str(module)
