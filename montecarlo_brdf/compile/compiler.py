"""From a Python function to an object file's bytes, by numba.

Every kernel has one signature, `void kernel(int64*, double*, double*)`, and numba's native
convention around it, whose returned status is not 0 when the function raised.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from montecarlo_brdf.compile import linking, native, twins
from montecarlo_brdf.compile.bind import Bound, Specialiser, is_strict
from montecarlo_brdf.compile.external import Kind, argument_types, kind_of

Function = Callable[..., Any]

#: Reassociation is what lets a sum vectorise; `nnan` and `ninf` are left out on purpose: with them
#: `isfinite(1/0)` is True and a NaN in a BRDF goes unseen.
FASTMATH = ("afn", "arcp", "contract", "nsz", "reassoc")
#: What an object may take from the process: the mathematics and memory functions of libc. Anything
#: else (numba's run time, Python's own API) means that it must be run by numba itself.
LIBC = frozenset([
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh",
    "acosh", "atanh", "sincos", "exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "pow",
    "sqrt", "cbrt", "hypot", "erf", "erfc", "tgamma", "lgamma", "fabs", "floor", "ceil", "trunc",
    "rint", "round", "nearbyint", "fmod", "fma", "fmax", "fmin", "ldexp", "frexp", "copysign",
    "sinf", "cosf", "tanf", "asinf", "acosf", "atanf", "atan2f", "sinhf", "coshf", "tanhf",
    "asinhf", "acoshf", "atanhf", "sincosf", "expf", "exp2f", "expm1f", "logf", "log2f", "log10f",
    "log1pf", "powf", "sqrtf", "cbrtf", "hypotf", "erff", "erfcf", "tgammaf", "lgammaf", "fabsf",
    "floorf", "ceilf", "truncf", "rintf", "roundf", "nearbyintf", "fmodf", "fmaf", "fmaxf", "fminf",
    "ldexpf", "frexpf", "copysignf", "memcpy", "memset", "memmove",
])  # fmt: skip
#: How everything but the kernel itself is compiled: only ever called from other compiled code.
INLINE = {"forceinline": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
KERNEL = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


class NeedsRuntime(Exception):
    """The compiled function calls into numba's or Python's run time."""


def options(strict: bool = False) -> dict[str, Any]:
    """Compile options; strict=True forbids every floating-point rewrite."""
    return {"error_model": "numpy", "fastmath": False if strict else set(FASTMATH)}


def compiled(function: Callable[..., Any], strict: bool = False) -> Any:
    """`function` as a numba dispatcher with our options (and never numba's own file cache)."""
    import numba

    return numba.njit(**options(strict or is_strict(function)))(function)


def part(function: Function) -> Any:
    """A function that kernels are made of, as a dispatcher."""
    return _jit(function, **INLINE, pipeline_class=linking.pipeline())


@functools.cache
def specialiser(compile_one: Callable[[Function], Any] = part) -> Specialiser:
    """One for the process, so that kernels share the functions they have in common."""
    return Specialiser(compile_one, twins.compiled_twins())


def assembled(template: Bound, compile_one: Callable[[Function], Any] = part) -> Function:
    """A template with its holes filled by what `compile_one` makes."""
    return specialiser(compile_one).clone(template.function, dict(template.names))


def is_mistake(error: Exception) -> bool:
    """Whether numba complains about what a user's function does, not about itself."""
    from numba.core import errors

    return isinstance(error, (errors.TypingError, errors.UnsupportedError))


def object_file(module: Any) -> bytes:
    """An LLVM module with the entry of a kernel as an object file.

    Raises NeedsRuntime if it needs more than libc.
    """
    _finish(module)
    return bytes(native.machine().emit_object(module))


def assembly(module: Any) -> str:
    """The same as assembly text, to look at the instructions of a loop."""
    _finish(module)
    return str(native.machine().emit_assembly(module))


def _finish(module: Any) -> None:
    native.optimise(module)
    missing = sorted(
        f.name
        for f in module.functions
        if f.is_declaration and not f.name.startswith("llvm.") and f.name not in LIBC
    )
    if missing:
        raise NeedsRuntime(", ".join(missing))


def by_numba(function: Function) -> native.Entry:
    """`function`, specialised from whole functions, compiled and run by numba's public way alone:
    for what needs its run time, and for releases of numba that are not known here."""
    import numba

    inner = compiled(function)

    def guarded(ints, reals, out):  # type: ignore[no-untyped-def]
        try:
            inner(ints, reals, out)
        except Exception:
            return 1
        return 0

    entry = numba.cfunc(numba.int32(*_pointers()), **options())(guarded)
    return native.plain(entry.address or 0, entry)


def entry_module(function: Function) -> Any:
    """`function(ints, reals, out)`, specialised from parts, and all it reaches as an LLVM module.

    Raises numba's own errors if it does not compile.
    """
    return _module(function, native.ENTRY, _pointers(), KERNEL)[1]


def unit_module(function: Function, vectors: int) -> tuple[Kind, Any]:
    """A function of a model, as templates call it, likewise, and what it returns.

    Raises Unknown if that is no number and no tuple of such.
    """
    returns, module = _module(function, native.ENTRY, argument_types(vectors), INLINE)
    return kind_of(returns), module


def _module(
    function: Function, entry: str, types: tuple[Any, ...], options: dict[str, bool]
) -> tuple[Any, Any]:
    dispatcher = _jit(function, types, **options, pipeline_class=linking.pipeline())
    (overload,) = dispatcher.overloads.values()
    name = overload.fndesc.llvm_func_name
    return overload.signature.return_type, linking.linked(overload.library, name, entry)


def _jit(function: Function, *signature: Any, **more: Any) -> Any:
    import numba

    decorated: Any = numba.njit
    return decorated(*signature, **more, **options(is_strict(function)))(function)


def _pointers() -> tuple[Any, ...]:
    """The types of a kernel's arguments."""
    import numba

    return (numba.types.CPointer(numba.int64),) + (numba.types.CPointer(numba.float64),) * 2
