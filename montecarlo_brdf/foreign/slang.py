"""The Slang compiler, in a library of the wheel: HLSL and Slang to SPIR-V.

A library may crash or never return: only ever called in a process of its own.
"""

from __future__ import annotations

import ctypes
import functools
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from montecarlo_brdf.foreign import wheel

LANGUAGE = 2025  # the least version of Slang that is asked for
TARGET = "-target spirv -profile spirv_1_3 -stage compute -entry bc_main -o x".split()  # noqa: SIM905
_STRING, _POINTER = ctypes.c_char_p, ctypes.c_void_p


class Compiled(NamedTuple):
    """SPIR-V, empty where a text does not compile, what was said, and which files were read."""

    binary: bytes
    told: str
    files: list[Path]


class _Session(ctypes.Structure):
    """The library's own record of what a session is for."""

    _fields_ = [
        ("size", ctypes.c_uint32),
        ("version", ctypes.c_uint32),
        ("language", ctypes.c_uint32),
        ("glsl", ctypes.c_bool),
        ("reserved", ctypes.c_uint32 * 16),
    ]


#: function of the library -> what it gives and takes
FUNCTIONS = {
    "slang_createGlobalSession2": (ctypes.c_int, [ctypes.POINTER(_Session), _POINTER]),
    "spCreateCompileRequest": (_POINTER, [_POINTER]),
    "spDestroyCompileRequest": (None, [_POINTER]),
    "spProcessCommandLineArguments": (ctypes.c_int, [_POINTER, _POINTER, ctypes.c_int]),
    "spCompile": (ctypes.c_int, [_POINTER]),
    "spGetDiagnosticOutput": (_STRING, [_POINTER]),
    "spGetEntryPointCode": (_POINTER, [_POINTER, ctypes.c_int, ctypes.POINTER(ctypes.c_size_t)]),
    "spGetDependencyFileCount": (ctypes.c_int, [_POINTER]),
    "spGetDependencyFilePath": (_STRING, [_POINTER, ctypes.c_int]),
}


@functools.cache
def _library() -> ctypes.CDLL:
    library = ctypes.CDLL(str(wheel.library("slang-compiler.")))
    for name, (gives, takes) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype, function.argtypes = gives, takes
    return library


@functools.cache
def _session() -> int:
    """A session of the compiler; its own front end for GLSL, which takes a second, stays out."""
    asked, made = _Session(size=ctypes.sizeof(_Session), language=LANGUAGE), ctypes.c_void_p()
    _library().slang_createGlobalSession2(ctypes.byref(asked), ctypes.byref(made))
    return made.value or 0


def spirv(path: Path, options: list[str]) -> Compiled:
    """SPIR-V of a file whose name says its language."""
    library = _library()
    request = library.spCreateCompileRequest(_session())
    words = [str(path).encode(), *(o.encode() for o in (*options, *TARGET))]
    array = (_STRING * len(words))(*words)
    failed = library.spProcessCommandLineArguments(request, array, len(words))
    failed = library.spCompile(request) if failed >= 0 else failed
    told = (library.spGetDiagnosticOutput(request) or b"").decode(errors="replace")
    found = Compiled(b"", told, [])
    if not failed:  # or the library crashes
        found = Compiled(_code(request), told, list(_read(request)))
    library.spDestroyCompileRequest(request)
    return found


def _read(request: int) -> Iterator[Path]:
    """The files that a program is made of."""
    for k in range(_library().spGetDependencyFileCount(request)):
        path = _library().spGetDependencyFilePath(request, k)
        if path:
            yield Path(path.decode())


def _code(request: int) -> bytes:
    size = ctypes.c_size_t()
    place = _library().spGetEntryPointCode(request, 0, ctypes.byref(size))
    return ctypes.string_at(place, size.value) if place else b""
