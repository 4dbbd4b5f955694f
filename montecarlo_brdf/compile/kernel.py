"""From a model's functions to a callable kernel: memory, then disk, then the compiler."""
from __future__ import annotations

import contextlib
import functools
import gc
import sys
import threading
import warnings
from collections.abc import Callable, Hashable, Iterator
from pathlib import Path
from typing import Any, Protocol

from montecarlo_brdf.compile import cache, compiler, linking, native, twins
from montecarlo_brdf.compile import layout as layouts
from montecarlo_brdf.compile.bind import Specialiser
from montecarlo_brdf.compile.fingerprint import Fingerprint
from montecarlo_brdf.errors import ModelError, UserError

Function = Callable[..., Any]


class Buildable(Protocol):
    """A description from which a kernel can be made, with a hash of everything it depends on."""

    def key(self) -> str:
        """Hash of everything the machine code depends on."""
        ...

    def parts(self) -> Hashable:
        """The very objects it is made of: within a process the same objects are the same kernel."""
        ...

    def assemble(self, special: Specialiser) -> Function:
        """The template with everything bound, ready to be compiled."""
        ...


def fingerprint(layout: layouts.Layout) -> Fingerprint:
    """A hash begun with what every kernel depends on."""
    content = Fingerprint()
    content.add(native.identity())
    content.add(_compiler_source())
    content.add(layout.key())
    return content


@functools.cache
def _compiler_source() -> tuple[bytes, ...]:
    """The files that say how code is generated, as opposed to what it computes."""
    sources = (twins, compiler, linking, native, layouts, sys.modules[__name__])
    return tuple(Path(str(m.__file__)).read_bytes() for m in sources)


_loaded: dict[str, native.NativeKernel] = {}
_seen: dict[Hashable, native.NativeKernel] = {}  # spares the hash of all code at every call
_lock = threading.Lock()


def kernel_of(recipe: Buildable) -> native.NativeKernel:
    """The compiled kernel of a recipe."""
    parts = recipe.parts()
    if parts in _seen:
        return _seen[parts]
    key = recipe.key()
    with _lock:
        if key not in _loaded:
            _loaded[key] = _from_disk(key) or _from_source(recipe, key)
            _loaded[key].key = key  # type: ignore[attr-defined]  # partial sums are found by it
        _seen[parts] = _loaded[key]
        return _loaded[key]


def _from_disk(key: str) -> native.NativeKernel | None:
    image = cache.read(key)
    return native.load(image) if image else None


def _from_source(recipe: Buildable, key: str) -> native.NativeKernel:
    with _no_collection(), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what matters of them shows in an error or in the verdict
        try:
            image = compiler.compile_function(recipe.assemble(specialiser(compiler.part)))
        except compiler.NeedsRuntime:
            return compiler.compile_in_process(recipe.assemble(specialiser()))
    cache.write(key, image)
    return native.load(image)


@contextlib.contextmanager
def _no_collection() -> Iterator[None]:
    """A compiler allocates much and frees little: looking for garbage took a tenth of its time."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


@functools.cache
def specialiser(compile_one: Callable[[Function], Any] = compiler.whole) -> Specialiser:
    """One for the process, so that kernels share the functions they have in common."""
    return Specialiser(compile_one, twins.compiled_twins())


def buffer(size: int) -> Any:
    """Intrinsic that reserves `size` doubles on the kernel's stack."""
    import llvmlite.ir as ir
    import numba
    from numba.core import cgutils
    from numba.extending import intrinsic

    @intrinsic
    def buffer(typing: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            room = cgutils.alloca_once(builder, ir.DoubleType(), size=size)
            room.align = 64  # or half of all vectors straddle two lines of the cache
            return room

        return numba.types.CPointer(numba.float64)(), generate

    return buffer


def compiled(name: str, recipe: Buildable) -> Any:
    """The kernel of a recipe for model `name`; numba's complaints become one sentence."""
    try:
        return kernel_of(recipe)
    except (MemoryError, UserError):
        raise
    except Exception as error:  # what numba cannot compile ends in errors of every kind
        raise ModelError(f"model {name} does not compile: {_first_reason(error)}") from error


def _first_reason(error: Exception) -> str:
    """The line of a numba error that says what is wrong, without its stack of contexts."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    telling = [line for line in lines if not line.startswith(("Failed in", "During:", "-", "File"))]
    reason = (telling or lines or ["numba gave no reason"])[0]
    return " ".join(reason.partition(": %")[0].split())[:300]  # without the machine's own names
