"""A kernel: a template with everything bound, compiled when it is first called.

Machine code is found in memory, then on disk, else made by our own use of numba and LLVM: of parts
that are kept (`bitcode`), else as a whole (`compiler`). Where that breaks, as it may with another
release of either, numba compiles by its public way: slower, not stored, and said once.
"""
from __future__ import annotations

import contextlib
import functools
import gc
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from montecarlo_brdf.compile import bitcode, cache, compiler, native
from montecarlo_brdf.compile.bind import Bound, Function, bound
from montecarlo_brdf.compile.external import Unknown
from montecarlo_brdf.errors import ModelError, Raised, UserError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: seconds that a call should take at most: Ctrl-C and time limits wait for one
LONGEST = 0.05
#: evaluations of the first call, as long as nothing is known
FIRST = 64


class Kernel:
    """kernel(ints, reals, out), three addresses; raises ModelError where the model's code does."""

    def __init__(self, template: Bound, model: str) -> None:
        self._template, self._model = template, model
        self._entry: native.Entry | None = None
        #: seconds that an evaluation took in the call before, None as long as nothing is known
        self.pace: float | None = None

    def __call__(self, ints: int, reals: int, out: int) -> None:
        if (self._entry or self.entry)(ints, reals, out) != 0:
            raise Raised(f"model {self._model} raised an exception while it was evaluated")

    @functools.cached_property
    def key(self) -> str:
        """Hash of everything the machine code depends on."""
        return bitcode.name_of(self._template)

    @property
    def entry(self) -> native.Entry:
        """The machine code. Raises ModelError if the model's functions can not be compiled."""
        with _lock:
            self._entry = self._entry or self._compiled()
            return self._entry

    def on(self, ints: Sequence[int], reals: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """A call with arrays."""
        import numpy as np

        numbers = np.array(ints, dtype=np.int64)
        self(numbers.ctypes.data, reals.ctypes.data, out.ctypes.data)

    def pieces(self, n: int, each: int = 1) -> Iterator[tuple[int, int]]:
        """(start, count) of each call over n items of `each` evaluations, as many items as the pace
        allows. How work is cut never shows in results: every item is computed alone."""
        start = 0
        while start < n:
            count = min(n - start, max(1, self.affordable(LONGEST, FIRST) // each))
            began = time.perf_counter()
            yield start, count
            self.timed(count * each, time.perf_counter() - began)
            start += count

    def timed(self, evaluations: int, seconds: float) -> None:
        """Remember how long a call took."""
        self.pace = max(seconds / evaluations, 1e-10)

    def affordable(self, seconds: float, first: int) -> int:
        """Evaluations of a call that is not too long; `first` as long as nothing is known."""
        return first if self.pace is None else int(seconds / self.pace)

    def _compiled(self) -> native.Entry:
        """Our way, else numba's public one; a mistake of the user's becomes one sentence."""
        with _no_collection(), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what matters of them shows in an error or a verdict
            try:
                return self._ours()
            except (MemoryError, UserError):
                raise
            except Exception as error:  # other releases of numba break in ways of their own
                if compiler.is_mistake(error):
                    raise self._mistake(error) from error
                ours = error
            try:
                entry = compiler.by_numba(self.assembled(compiler.compiled))
            except Exception as error:
                raise self._mistake(error) from error
            if not isinstance(ours, compiler.NeedsRuntime):
                _tell(ours)
            return entry

    def _ours(self) -> native.Entry:
        image = cache.read(self.key)
        if not image:
            for hear in listeners:
                hear(self._model)
            image = compiler.object_file(self.module())
            cache.write(self.key, image)
        return native.load(image)

    def module(self) -> Any:
        """The LLVM module: of parts that are kept, else of the whole."""
        try:
            return bitcode.module_of(self._template)
        except Unknown:
            return compiler.entry_module(self.assembled())
        except Exception as error:
            if not compiler.is_mistake(error):
                raise
            return compiler.entry_module(self.assembled())  # what is wrong with it is told better

    def assembled(self, compile_one: Callable[[Function], Any] = compiler.part) -> Function:
        """The template with its holes filled by what `compile_one` makes."""
        return compiler.assembled(self._template, compile_one)

    def _mistake(self, error: Exception) -> ModelError:
        return ModelError(f"model {self._model} does not compile: {_first_reason(error)}")


#: are told of a model whose code is compiled for the first time
listeners: list[Callable[[str], None]] = []
_lock = threading.RLock()  # numba and what is shared between kernels serve one thread
_kernels: dict[Bound, Kernel] = {}  # spares the hash of all code at every call


def kernel(model: str, template: Function, **names: object) -> Kernel:
    """The kernel of a template with names bound, for the functions of a model; one in a process."""
    parts = bound(template, **names)
    return _kernels.get(parts) or _kernels.setdefault(parts, Kernel(parts, model))


_told: list[Exception] = []


def _tell(error: Exception) -> None:
    """Say once that kernels are compiled another way."""
    if not _told:
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        sys.stderr.write(
            "note: this release of numba or llvmlite is not known here; kernels are compiled by "
            f"numba's public way, which is slower ({reason})\n"
        )
    _told.append(error)


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


def _first_reason(error: Exception) -> str:
    """The line of a numba error that says what is wrong, without its stack of contexts."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    telling = [line for line in lines if not line.startswith(("Failed in", "During:", "-", "File"))]
    reason = (telling or lines or ["numba gave no reason"])[0]
    return " ".join(reason.partition(": %")[0].split())[:300]  # without the machine's own names
