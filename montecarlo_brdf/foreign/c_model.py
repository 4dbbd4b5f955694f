"""A model in C or C++, or in a shared library, as the namespace of a model file.

`brdf.c` is described by comments like a shader. `lib.so:name` has `double name(const double *wo,
const double *wi, const double *p)`, perhaps `void name_sample(const double *wo, const double *u,
const double *p, double *wi)`, `double name_pdf(...)` like name, and `const char *name_params =
"roughness = 0.3 in [0.05, 1]; ..."`.
"""

from __future__ import annotations

import base64
import contextlib
import ctypes
import functools
import hashlib
import os
import re
import shutil
import tempfile
import types
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from montecarlo_brdf.foreign import translation

SUFFIXES = (".c", ".cc", ".cpp", ".cxx")
LIBRARY = re.compile(r"(?P<path>.+\.(?:so|dylib|dll)):(?P<name>\w+)")
COMPILERS = ("clang", "clang++", "cc", "c++")


def is_c(spec: str) -> bool:
    """Whether a model is asked for by the path of C, C++ or a library."""
    return spec.endswith(SUFFIXES) or bool(LIBRARY.fullmatch(spec))


def parts(spec: str) -> tuple[Path, str]:
    """The file, and the function in it if it is a library."""
    match = LIBRARY.fullmatch(spec)
    return (Path(match["path"]), match["name"]) if match else (Path(spec), "")


def module(spec: str, said: Sequence[tuple[str, str]] = ()) -> types.ModuleType:
    """The module of a file. said: statements that stand elsewhere, with their places.

    Raises ModelError with one sentence.
    """
    path, name = parts(spec)
    compilers = [str(shutil.which(x)) for x in COMPILERS]
    said = [(f"library {name}", "")] if name else said
    known = translation.answered("c_translate", path, said, *compilers)
    made = translation.module(path, known["text"])
    vars(made).update(calls(known, path))
    return made


def calls(known: dict[str, Any], path: Path) -> dict[str, Any]:
    """What the functions of the model call."""
    from montecarlo_brdf.compile.c_call import Call

    code, library = known["code"], known["library"]
    content = hashlib.sha256((code + library).encode()).hexdigest()
    find = functools.partial(_found, code, library or str(path.resolve()))
    return {
        f"CALL_{key}": Call(symbol, content, known["inputs"], key == "sample", code,
                            functools.partial(find, symbol))
        for key, symbol in known["symbols"].items()
    }  # fmt: skip


def _found(code: str, library: str, symbol: str) -> int:
    """The address of a function."""
    if code:
        from montecarlo_brdf.compile.c_call import engine

        return int(engine(code).get_function_address(symbol))
    return ctypes.cast(getattr(opened(library), symbol), ctypes.c_void_p).value or 0


@functools.lru_cache(maxsize=64)
def opened(library: str) -> ctypes.CDLL:
    """A library by its path, or by its bytes as text. Raises OSError with what is missing."""
    if os.path.isabs(library):
        return ctypes.CDLL(library, mode=os.RTLD_NOW)
    with _temporary(base64.b64decode(library)) as path:
        return ctypes.CDLL(path, mode=os.RTLD_NOW)


@contextlib.contextmanager
def _temporary(content: bytes) -> Iterator[str]:
    """A file for as long as it takes to open it."""
    with tempfile.NamedTemporaryFile(suffix=".so", delete=False) as file:
        file.write(content)
    try:
        yield file.name
    finally:
        with contextlib.suppress(OSError):
            os.unlink(file.name)


