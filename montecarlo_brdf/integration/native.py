"""Machine code: from a Python function to an object file's bytes, and from bytes to a callable.

Compiling needs numba (a second or so); loading needs only llvmlite, so that a cached kernel starts
in milliseconds with numba never imported. Every kernel has one signature, `void kernel(int64*,
double*, double*)`, and numba's native convention around it, whose returned status is not 0 when
the function raised.
"""

from __future__ import annotations

import ctypes
import functools
import platform
import sys
from collections.abc import Callable
from typing import Any

from montecarlo_brdf import jit

ENTRY = "montecarlo_brdf_kernel"
NativeKernel = Callable[[Any, Any, Any], int]
_PROTOTYPE = ctypes.CFUNCTYPE(ctypes.c_int32, *[ctypes.c_void_p] * 5)

#: What an object may take from the process: the mathematics and memory functions of libc. Anything
#: else (numba's run time, Python's own API) means that it must be run by numba itself.
LIBC = frozenset(
    [
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "atan2",
        "sinh",
        "cosh",
        "tanh",
        "asinh",
        "acosh",
        "atanh",
        "exp",
        "exp2",
        "expm1",
        "log",
        "log2",
        "log10",
        "log1p",
        "pow",
        "sqrt",
        "cbrt",
        "hypot",
        "fabs",
        "floor",
        "ceil",
        "trunc",
        "rint",
        "round",
        "nearbyint",
        "fmod",
        "fma",
        "fmax",
        "fmin",
        "ldexp",
        "frexp",
        "copysign",
        "erf",
        "erfc",
        "tgamma",
        "lgamma",
        "sincos",
        "memcpy",
        "memset",
        "memmove",
        "sinf",
        "cosf",
        "tanf",
        "expf",
        "exp2f",
        "logf",
        "log2f",
        "powf",
        "sqrtf",
        "fmodf",
        "atan2f",
    ]
)


class NeedsRuntime(Exception):
    """The compiled function calls into numba's or Python's run time."""


@functools.cache
def target() -> tuple[str, str, str]:
    """Triple, name and features of this processor: part of every cache key."""
    binding = _llvm()
    features = binding.get_host_cpu_features()
    return binding.get_process_triple(), binding.get_host_cpu_name(), features.flatten()


@functools.cache
def identity() -> tuple[Any, ...]:
    """Everything outside the source that machine code depends on."""
    from importlib.metadata import version

    return (
        sys.version_info[:3],
        platform.machine(),
        version("numba"),
        version("llvmlite"),
        *target(),
    )


def compile_function(function: Callable[..., Any]) -> bytes:
    """`function(ints, reals, out)`, already specialised, as an object file.

    Raises NeedsRuntime if it needs more than libc, and numba's own errors if it does not compile.
    """
    machine = _machine()
    return bytes(machine.emit_object(_module(_overload(function), machine)))


def assembly(function: Callable[..., Any]) -> str:
    """The same as assembly text, to look at the instructions of a loop."""
    machine = _machine()
    return str(machine.emit_assembly(_module(_overload(function), machine)))


def compile_in_process(function: Callable[..., Any]) -> NativeKernel:
    """The same, run by numba itself: for functions that need its run time. Not cached."""
    overload = _overload(function)
    address = overload.library.get_pointer_to_function(overload.fndesc.llvm_func_name)
    return _callable(address, overload)


def _overload(function: Callable[..., Any]) -> Any:
    import numba

    pointers = (numba.types.CPointer(numba.int64),) + (numba.types.CPointer(numba.float64),) * 2
    options = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, **jit.options()}
    dispatcher = numba.njit(numba.void(*pointers), **options)(function)
    (overload,) = dispatcher.overloads.values()
    return overload


def _module(overload: Any, machine: Any) -> Any:
    """The LLVM module with nothing but the entry and what it needs of libc."""
    binding = _llvm()
    module = binding.parse_assembly(overload.library.get_llvm_str())
    for function in module.functions:
        if function.name == overload.fndesc.llvm_func_name:
            function.name = ENTRY
            function.linkage = "external"
        elif not function.is_declaration:
            function.linkage = "internal"
    _remove_dead_code(binding, module, machine)
    missing = sorted(
        f.name
        for f in module.functions
        if f.is_declaration and not f.name.startswith("llvm.") and f.name not in LIBC
    )
    if missing:
        raise NeedsRuntime(", ".join(missing))
    return module


def _remove_dead_code(binding: Any, module: Any, machine: Any) -> None:
    builder = binding.create_pass_builder(machine, binding.create_pipeline_tuning_options())
    manager = binding.create_new_module_pass_manager()
    manager.add_global_dead_code_eliminate_pass()
    manager.run(module, builder)


def load(image: bytes) -> NativeKernel:
    """The kernel in an object file; keeps the loaded code alive as long as the callable."""
    binding = _llvm()
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _machine())
    engine.add_object_file(binding.ObjectFileRef.from_data(image))
    engine.finalize_object()
    address = engine.get_function_address(ENTRY)
    if not address:
        raise ValueError(f"object file without {ENTRY}")
    return _callable(address, engine)


def _callable(address: int, owner: Any) -> NativeKernel:
    """A Python function around machine code that lives as long as `owner`."""
    call = _PROTOTYPE(address)

    def kernel(ints: Any, reals: Any, out: Any) -> int:
        exception = ctypes.c_void_p()
        result = ctypes.c_int64()
        return int(call(ctypes.addressof(result), ctypes.addressof(exception), ints, reals, out))

    kernel.owner = owner  # type: ignore[attr-defined]
    return kernel


def _machine() -> Any:
    binding = _llvm()
    triple, cpu, features = target()
    reloc = "static" if triple.startswith(("x86", "i")) else "default"
    return binding.Target.from_default_triple().create_target_machine(
        cpu=cpu, features=features, opt=3, reloc=reloc, codemodel="jitdefault", jit=True
    )


@functools.cache
def _llvm() -> Any:
    import llvmlite.binding as binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding
