"""sin and cos of a model's own code as polynomials: a call to libm keeps a loop scalar and takes 10
to 20 ns; these inline and vectorise.

x is reduced to r in [-pi/2, pi/2]: k pi is taken away in three parts by fused steps, the first of
which is exact (Cody and Waite 1980). Error: below 2 units in the last place for |x| below LARGEST.
Beyond it a unit in the last place of x is a sixteenth of a radian and its sine means nothing: NaN.
Coefficients: scripts/polynomials.py.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.compile import native

if TYPE_CHECKING:
    from llvmlite.ir import Value

#: what numba calls -> the function that stands for it
TWINS = {"llvm.sin.f64": "montecarlo_brdf_sin", "llvm.cos.f64": "montecarlo_brdf_cos"}
LARGEST = 2.0**48
PI = (3.141592653589793, 1.2246467991473532e-16, -2.994769810131746e-33)
#: (sin r - r)/r^3 in r^2, error 4e-19
REST = (
    2.731441604451164e-15, -7.643970043159376e-13, 1.6058977304519656e-10, -2.5052107616873647e-08,
    2.7557319219162273e-06, -0.00019841269841254971, 0.008333333333333316, -0.16666666666666666,
)  # fmt: skip
ROUNDER = 6755399441055744.0  # 1.5 2^52: in a sum with it a number is rounded to an integer


class _Code:
    """Instructions of doubles, none of which the compiler may reorder."""

    def __init__(self, module: Any, symbol: str) -> None:
        import llvmlite.ir as ir

        self.double, self.word = ir.DoubleType(), ir.IntType(64)
        form = ir.FunctionType(self.double, [self.double])
        function = ir.Function(module, form, symbol)
        function.attributes.add("alwaysinline")
        self.builder = ir.IRBuilder(function.append_basic_block())
        (self.x,) = function.args
        self.fma = module.declare_intrinsic("llvm.fma", [self.double] * 3)
        self.abs = module.declare_intrinsic("llvm.fabs", [self.double])

    def number(self, value: float) -> Value:
        """A constant."""
        return self.double(value)

    def fused(self, a: Value, b: Value, c: Value) -> Value:
        """a b + c, rounded once."""
        return self.builder.call(self.fma, [a, b, c])

    def polynomial(self, q: Value, coefficients: Sequence[float]) -> Value:
        """From the highest power down."""
        value = self.number(coefficients[0])
        for c in coefficients[1:]:
            value = self.fused(value, q, self.number(c))
        return value

    def finish(self, shift: float) -> None:
        """Return sin(x + shift pi), shift 0 or 1/2."""
        b, number = self.builder, self.number
        rounded = b.fadd(
            self.fused(self.x, number(1.0 / math.pi), number(-shift)), number(ROUNDER)
        )
        k = b.fadd(b.fsub(rounded, number(ROUNDER)), number(shift))
        away, r = b.fneg(k), self.x
        for part in PI:
            r = self.fused(away, number(part), r)
        q = b.fmul(r, r)
        sine = self.fused(b.fmul(r, q), self.polynomial(q, REST), r)
        odd = b.shl(b.bitcast(rounded, self.word), self.word(63))
        turned = self.word(-(1 << 63) if shift else 0)  # half a turn more or less
        sign = b.xor(odd, turned)
        value = b.bitcast(b.xor(b.bitcast(sine, self.word), sign), self.double)
        near = b.fcmp_ordered("<", b.call(self.abs, [self.x]), number(LARGEST))
        b.ret(b.select(near, value, number(math.nan)))


def text() -> str:
    """Both functions as text of LLVM."""
    import llvmlite.ir as ir

    module = ir.Module(name="sines")
    for (_, symbol), shift in zip(TWINS.items(), (0.0, 0.5), strict=True):
        _Code(module, symbol).finish(shift)
    return str(module)


def substitute(module: Any) -> None:
    """Have a module of LLVM call these, on processors that fuse."""
    triple, _, features = native.target()
    if "+fma" in features.split(",") or triple.startswith(("aarch64", "arm64")):
        for function in module.functions:
            if function.name in TWINS:
                function.name = TWINS[function.name]


def needed(module: Any) -> bool:
    """Whether it calls them."""
    return any(f.name in TWINS.values() for f in module.functions if f.is_declaration)
