"""The reference compiler of GLSL, in a library of the wheel, and an optimiser of SPIR-V.

A library may crash or never return: only ever called in a process of its own.
"""

from __future__ import annotations

import ctypes
import functools

from montecarlo_brdf.foreign import wheel

COMPILE, OPTIMISE = 0, 2  # what a request asks for
FRAGMENT = 5  # the stage in which derivatives and discard are legal
LEVEL = 2
_SINK = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p)


class _Request(ctypes.Structure):
    """The library's own record of what is asked; the order is its."""

    _fields_ = [
        ("size", ctypes.c_size_t),
        ("path", ctypes.c_char_p),
        ("begin", ctypes.c_void_p),
        ("end", ctypes.c_void_p),
        ("tell", _SINK),
        ("tell_data", ctypes.c_void_p),
        ("give", _SINK),
        ("give_data", ctypes.c_void_p),
        ("stage", ctypes.c_int),
        ("action", ctypes.c_uint),
        ("level", ctypes.c_uint),
        ("debug", ctypes.c_uint),
        ("target", ctypes.c_char_p),
        ("version", ctypes.c_int * 3),
        ("entry", ctypes.c_char_p),
    ]


@functools.cache
def _library() -> ctypes.CDLL:
    return ctypes.CDLL(str(wheel.library("slang-glslang-")))


def spirv(text: str, path: str) -> tuple[bytes, str]:
    """SPIR-V of a GLSL text, empty where it does not compile, and what the compiler said."""
    return _asked(text.encode(), path, COMPILE)


def optimised(binary: bytes) -> bytes:
    """The same with dead code, copies, calls and pointers gone."""
    return _asked(binary, "", OPTIMISE)[0] or binary


def _asked(content: bytes, path: str, action: int) -> tuple[bytes, str]:
    given, told = list[bytes](), list[bytes]()
    buffer = ctypes.create_string_buffer(content, len(content) + 1)
    request = _Request(size=ctypes.sizeof(_Request), path=path.encode(), entry=b"main")
    request.begin = ctypes.addressof(buffer)
    request.end = request.begin + len(content)
    request.tell = _SINK(lambda data, size, _: told.append(ctypes.string_at(data, size)))
    request.give = _SINK(lambda data, size, _: given.append(ctypes.string_at(data, size)))
    request.stage, request.action = FRAGMENT, action
    request.level = LEVEL if action == OPTIMISE else 0
    request.target, request.version = b"spirv1.3", (1, 3, 0)
    _library().glslang_compile_1_2(ctypes.byref(request))
    return b"".join(given), b"".join(told).decode(errors="replace")
