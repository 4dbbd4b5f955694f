"""From a model's functions to a callable kernel: memory, then disk, then the compiler."""
from __future__ import annotations

import contextlib
import functools
import gc
import sys
import threading
from collections.abc import Callable, Hashable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from montecarlo_brdf import bits, jit
from montecarlo_brdf.integration import cache, compiler, kernel, linking, native, parameters
from montecarlo_brdf.integration.fingerprint import Fingerprint
from montecarlo_brdf.integration.integrands import PLANE
from montecarlo_brdf.integration.reach import takes_more
from montecarlo_brdf.integration.specialise import Specialiser
from montecarlo_brdf.sampling import points as point_sets

Function = Callable[..., Any]

#: What a kernel calls its integrands.
NAMES = ("FIRST", "SECOND", "THIRD", "FOURTH", "FIFTH")


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


class Wrapped(NamedTuple):
    """An integrand that another one evaluates, as INSIDE, at points of its own."""

    outer: Function
    inner: Function


class Recipe(NamedTuple):
    """All that a kernel of means is made of."""

    points: str
    integrands: tuple[Function | Wrapped, ...]
    functions: Mapping[str, Function]  # what F, SAMPLE, PDF stand for in the integrands
    layout: parameters.Layout

    @property
    def channels(self) -> int:
        """Number of parameter sets."""
        return len(self.layout.places)

    def point_set(self) -> Function:
        """The points; of Sobol's only the coordinates that the integrands use."""
        if self.points == "sobol" and all(i in PLANE for i in self.integrands):
            choosing = takes_more(self.functions.get("SAMPLE"), 1, 2)
            return point_sets.sobol_plane if choosing else point_sets.sobol_pair
        found: Function = getattr(point_sets, self.points)
        return found

    def _shape(self) -> Function:
        return kernel.shaped if self.points in point_sets.SHAPES else kernel.shapeless

    def key(self) -> str:
        """Hash of everything the machine code depends on."""
        content = fingerprint(self.layout)
        content.add((self.point_set(), self._shape()))
        for integrand in self.integrands:
            if isinstance(integrand, Wrapped):
                content.add(integrand.outer)
                integrand = integrand.inner
            content.add(integrand, self.functions)
        content.add(kernel.moments)
        content.add(len(self.integrands))
        return content.hexdigest()

    def parts(self) -> Hashable:
        """Points, functions and layout."""
        return self.points, self.integrands, frozenset(self.functions.items()), self.layout

    def assemble(self, special: Specialiser) -> Function:
        """The template `moments` with everything bound."""
        integrands = [self._bound(special, i) for i in self.integrands]
        bound = {
            "POINTS": self.point_set(),
            "SHAPE": self._shape(),
            "STORE": _store(special, integrands),
            "PARAMETERS": parameters.unpacker(self.layout),
            "BUFFER": buffer(kernel.ROOM * self.channels * len(integrands)),
            "ROW": buffer(kernel.ROOM),
            "CHANNELS": self.channels,
            "SLOTS": len(integrands),
        }
        return special.clone(kernel.moments, bound)

    def _bound(self, special: Specialiser, integrand: Function | Wrapped) -> Any:
        if isinstance(integrand, Wrapped):
            inside = special.bind(integrand.inner, self.functions)
            return special.bind(integrand.outer, {"INSIDE": inside})
        return special.bind(integrand, self.functions)


def fingerprint(layout: parameters.Layout) -> Fingerprint:
    """A hash begun with what every kernel depends on."""
    content = Fingerprint()
    content.add(native.identity())
    content.add(_compiler_source())
    content.add(layout.key())
    return content


@functools.cache
def _compiler_source() -> tuple[bytes, ...]:
    """The files that say how code is generated, as opposed to what it computes."""
    sources = (bits, jit, compiler, linking, native, parameters, sys.modules[__name__])
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
    with _no_collection():
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
    return Specialiser(compile_one, bits.compiled_twins())


def _store(special: Specialiser, integrands: list[Any]) -> Any:
    """A function that evaluates each integrand into its own slot."""
    if len(integrands) > len(NAMES):
        raise ValueError(f"{len(integrands)} integrands in one kernel; {len(NAMES)} are allowed")
    spare = [integrands[0]] * (len(NAMES) - len(integrands))  # typed, never called
    bound = dict(zip(NAMES, integrands + spare, strict=True))
    return special.bind(kernel.store, {**bound, "SLOTS": len(integrands)})


def buffer(size: int) -> Any:
    """Intrinsic that reserves `size` doubles on the kernel's stack."""
    import llvmlite.ir as ir
    import numba
    from numba.core import cgutils
    from numba.extending import intrinsic

    @intrinsic
    def buffer(typing: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return cgutils.alloca_once(builder, ir.DoubleType(), size=size)

        return numba.types.CPointer(numba.float64)(), generate

    return buffer
