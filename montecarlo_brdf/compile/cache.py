"""Compiled kernels on disk, and parts of them: one file each, named by the hash of everything it
depends on, so that a stored one can never be stale.

A file is a digest and an object file, or bitcode. It is written beside its final name and moved
there, so two processes that compile the same kernel at once cannot disturb each other; a damaged
file does not match its digest and counts as absent; a cache that cannot be written is not an error,
only slow. Folders that are only read may lie below the one that is written (`compile.folders`).
Beside them lie notes: files of lines, each with its digest, to which any process may add.
"""
from __future__ import annotations

import contextlib
import enum
import hashlib
import os
import tempfile
import time
import types
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from montecarlo_brdf.compile import folders
from montecarlo_brdf.compile.bind import (
    Bound,
    Instruction,
    is_own_module,
    is_strict,
    module_functions,
    names_used,
    plain,
    references,
    uses,
)

DIGEST = 16
LARGEST_NOTES = 1 << 20  # bytes; a file of notes beyond that is begun anew
LEFT_BEHIND = 3600.0  # seconds after which nobody writes a file any more
#: Values whose repr is all there is to know about them.
PLAIN = (int, float, complex, str, bytes, type(None), type(...), slice, range)
PLAIN_MODULES = ("numpy", "numba.core.types")
_PROCESS = os.urandom(16)
_unknown: dict[int, Any] = {}


def read(name: str) -> bytes | None:
    """The stored image, or None if it is absent, unreadable or damaged."""
    images = ((c[:DIGEST], c[DIGEST:]) for c in _contents(f"{name}.o"))
    found = next((image for digest, image in images if digest == _digest(image)), None)
    folders.count_use(found is not None)
    return found


def write(name: str, image: bytes) -> None:
    """Store an image; silently do without where the directory cannot be written."""
    if DIGEST + len(image) > folders.limit():
        return
    folder = folders.directory()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=folder, suffix=".part")
    except OSError:
        return
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(_digest(image) + image)
        os.replace(temporary, folder / f"{name}.o")
        folders.keep_within(folder, DIGEST + len(image))
        clear_leftovers(folder)
    except OSError:
        with contextlib.suppress(OSError):
            os.unlink(temporary)


def notes(name: str) -> list[str]:
    """The lines noted under a name, without damaged ones."""
    lines = (line for content in _contents(f"{name}.txt") for line in content.splitlines())
    whole = (line.partition(b" ") for line in lines)
    return [text.decode() for digest, _, text in whole if digest == _digest(text).hex().encode()]


def _contents(name: str) -> Iterator[bytes]:
    """A file's in each folder that has it, which counts as used now."""
    for folder in folders.folders():
        with contextlib.suppress(OSError):
            content = (folder / name).read_bytes()
            with contextlib.suppress(OSError):  # of a folder that is only read
                os.utime(folder / name)
            yield content


def note(name: str, line: str) -> None:
    """Add a line; silently do without where the directory cannot be written."""
    path, text = folders.directory() / f"{name}.txt", line.encode()
    with contextlib.suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "ab") as file:  # one write of a short line: processes do not mix theirs
            if file.tell() > LARGEST_NOTES:
                file.truncate(0)
            file.write(_digest(text).hex().encode() + b" " + text + b"\n")


def _digest(image: bytes) -> bytes:
    return hashlib.blake2b(image, digest_size=DIGEST).digest()


def clear_leftovers(folder: Path) -> None:
    """Remove what processes that were killed while they wrote have left."""
    for path in folder.glob("*.part"):
        with contextlib.suppress(OSError):
            if time.time() - path.stat().st_mtime > LEFT_BEHIND:
                path.unlink()


class Fingerprint:
    """Content hash of values and of all the code that a function reaches: code, constants, arrays,
    defaults and closure cells."""

    def __init__(self) -> None:
        self._hash = hashlib.blake2b(digest_size=16)
        self._seen: dict[tuple[int, object], int] = {}
        self._modules: set[tuple[int, int]] = set()  # (module, code that uses it)

    def hexdigest(self) -> str:
        return self._hash.hexdigest()

    def add(self, value: Any, names: Mapping[str, object] | None = None) -> None:
        """Take in any value: code is followed, containers are walked, the rest goes by repr;
        `names` fill the holes of a template."""
        value = plain(value)
        if isinstance(value, Bound):
            self.add(value.function, dict(value.names))
        elif isinstance(value, types.FunctionType):
            self._add_function(value, names or {})
        elif isinstance(value, Instruction):
            self._text(type(value).__name__)
            self.add(value.key())
        elif isinstance(value, types.CodeType):
            self._add_code(value)
        elif isinstance(value, (tuple, list)):
            self._add_sequence(value)
        elif isinstance(value, (set, frozenset)):
            self._text("set")
            self._add_sequence(sorted(value, key=repr))
        elif isinstance(value, dict):
            self._text("dictionary")
            self._add_sequence(sorted(value.items(), key=repr))
        elif not isinstance(value, type) and hasattr(value, "tobytes") and hasattr(value, "dtype"):
            self._text(f"array {value.dtype} {value.shape}")
            self._hash.update(value.tobytes())
        elif isinstance(value, types.ModuleType):
            self._text(f"module {value.__name__}")
        elif isinstance(value, type):
            self._add_class(value)
        elif isinstance(value, types.BuiltinFunctionType):
            self._text(f"builtin {value.__module__}.{value.__qualname__}")
        elif isinstance(value, PLAIN) or type(value).__module__.startswith(PLAIN_MODULES):
            self._text(f"{type(value).__name__} {value!r}")
        else:
            self._add_unknown(value)

    def _text(self, text: str) -> None:
        self._hash.update(f"{len(text)}:{text};".encode())

    def _add_unknown(self, value: Any) -> None:
        """No content that could be hashed: the same kernel in this process, never in another."""
        _unknown[id(value)] = value  # kept alive, so that the id stays its own
        self._hash.update(_PROCESS)
        self._text(f"object {id(value)}")

    def _add_class(self, kind: type) -> None:
        """Names, fields and values of named tuples and enumerations, which kernels may use."""
        self._text(f"class {kind.__module__}.{kind.__qualname__}")
        if isinstance(kind, enum.EnumMeta):
            members: Mapping[str, Any] = kind.__members__
            self.add([(name, member.value) for name, member in members.items()])
        elif hasattr(kind, "_fields"):
            self.add((kind._fields, getattr(kind, "_field_defaults", {})))
        elif kind.__module__ != "builtins" and not kind.__module__.startswith(PLAIN_MODULES):
            self._add_unknown(kind)

    def _add_sequence(self, values: Any) -> None:
        self._text(f"{type(values).__name__} of {len(values)}")
        if hasattr(values, "_fields"):
            self._add_class(type(values))
        for value in values:
            self.add(value)

    def _add_code(self, code: types.CodeType) -> None:
        self._text(code.co_name)
        self._hash.update(code.co_code + code.co_exceptiontable)
        self.add(code.co_consts)
        self.add(code.co_names)
        self.add(code.co_varnames + code.co_freevars + code.co_cellvars)

    def _add_function(self, function: types.FunctionType, names: Mapping[str, object]) -> None:
        place = id(function), frozenset(names.items()) if uses(function, names) else None
        if place in self._seen:
            self._text(f"function {self._seen[place]} again")
            return
        self._seen[place] = len(self._seen)
        self._add_code(function.__code__)
        if is_strict(function):
            self._text("strict")
        self.add((function.__defaults__, function.__kwdefaults__))
        self.add([cell.cell_contents for cell in function.__closure__ or ()])
        for name, value in references(function, names).items():
            self._text(name)
            self.add(value, names if uses(value, names) else None)
            self._add_module(value, function.__code__)

    def _add_module(self, module: Any, code: types.CodeType) -> None:
        """What `code` may use of a user's module, and of the modules in it."""
        if not is_own_module(module) or (id(module), id(code)) in self._modules:
            return
        self._modules.add((id(module), id(code)))
        for name, value in module_functions(module, names_used(code)).items():
            self._text(name)
            self.add(value)
            self._add_module(value, code)
