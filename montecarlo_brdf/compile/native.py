"""Machine code: from an object file's bytes to a callable, and what such a file depends on.

Loading needs only llvmlite, so that a cached kernel starts in milliseconds with numba never
imported; `compiler` makes the files, and says how a kernel is called.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import importlib.util
import platform
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

ENTRY = "montecarlo_brdf_kernel"
#: entry(ints, reals, out), three addresses: 0, or the model's code raised an exception
Entry = Callable[[int, int, int], int]
_OURS = ctypes.CFUNCTYPE(ctypes.c_int32, *[ctypes.c_void_p] * 5)  # numba's own convention
_PLAIN = ctypes.CFUNCTYPE(ctypes.c_int32, *[ctypes.c_void_p] * 3)


@functools.cache
def target() -> tuple[str, str, str]:
    """Triple, name and features of this processor: part of every cache key."""
    binding = _llvm()
    features = binding.get_host_cpu_features()
    return binding.get_process_triple(), binding.get_host_cpu_name(), features.flatten()


@functools.cache
def identity() -> tuple[Any, ...]:
    """Everything outside the source that machine code depends on."""
    return (
        sys.version_info[:3],
        platform.machine(),
        release("numba"),
        release("llvmlite"),
        *target(),
    )


def release(package: str) -> str:
    """Which release of a package this is, from the file in which it keeps its version: to import
    the package takes half a second, to import importlib.metadata a tenth of a warm run."""
    spec = importlib.util.find_spec(package)
    for name in ("_version.py", "version.py"):
        with contextlib.suppress(OSError):
            return Path(str(spec and spec.origin)).with_name(name).read_text(encoding="utf-8")
    from importlib.metadata import version

    return version(package)


def load(image: bytes) -> Entry:
    """The kernel in an object file; keeps the loaded code alive as long as the callable."""
    binding = _llvm()
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), machine())
    engine.add_object_file(binding.ObjectFileRef.from_data(image))
    engine.finalize_object()
    address = engine.get_function_address(ENTRY)
    if not address:
        raise ValueError(f"object file without {ENTRY}")
    return _callable(address, engine)


def _callable(address: int, owner: object) -> Entry:
    """A Python function around machine code that lives as long as `owner`."""
    call = _OURS(address)

    def entry(ints: int, reals: int, out: int, owner: object = owner) -> int:
        exception, result = ctypes.c_void_p(), ctypes.c_int64()
        return int(call(ctypes.addressof(result), ctypes.addressof(exception), ints, reals, out))

    return entry


def plain(address: int, owner: object) -> Entry:
    """The same around a function of C."""
    call = _PLAIN(address)

    def entry(ints: int, reals: int, out: int, owner: object = owner) -> int:
        return int(call(ints, reals, out))

    return entry


def optimise(module: Any) -> None:
    """Make good code of an LLVM module."""
    binding, target = _llvm(), machine()
    options = binding.create_pipeline_tuning_options(speed_level=0)
    options.loop_vectorization = options.slp_vectorization = False
    builder = binding.create_pass_builder(target, options)
    passes = builder.getModulePassManager()
    passes.add_loop_rotate_pass()
    passes.add_instruction_combine_pass()
    passes.add_jump_threading_pass()
    passes.run(module, builder)
    options = binding.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization, options.slp_vectorization = True, False
    builder = binding.create_pass_builder(target, options)
    passes = builder.getModulePassManager()
    passes.run(module, builder)


def parsed(code: str | bytes) -> Any:
    """The LLVM module of a text or of bitcode. Raises RuntimeError for anything else."""
    binding = _llvm()
    return binding.parse_assembly(code) if isinstance(code, str) else binding.parse_bitcode(code)


def machine() -> Any:
    """LLVM's description of this processor, to generate code for it."""
    binding = _llvm()
    triple, cpu, features = target()
    return binding.Target.from_default_triple().create_target_machine(
        cpu=cpu, features=features, opt=3, reloc="pic", codemodel="small", jit=True
    )


@functools.cache
def _llvm() -> Any:
    import llvmlite.binding as binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding
