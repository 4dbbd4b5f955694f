"""Writing results: whole or not at all, and never over what was read."""
from __future__ import annotations

import contextlib
import os
import tempfile
from pathlib import Path

from montecarlo_brdf.errors import OutputError, UserError

_inputs: set[Path] = set()


def know_input(path: Path) -> None:
    """Remember that a file was read: nothing is written over it."""
    with contextlib.suppress(OSError, RuntimeError):  # a name that no file can have
        _inputs.add(path.resolve())


def inputs() -> set[Path]:
    """All files that were read."""
    return {*_inputs}


def is_input(path: Path) -> bool:
    """Whether a file was read."""
    return path.resolve() in _inputs


def forget_inputs() -> None:
    """Begin anew: what a command before this one read is its own."""
    _inputs.clear()


def check_no_input(path: Path) -> None:
    """Raise UserError if `path` was read in this process."""
    if is_input(path) and path.is_file():
        raise UserError(f"cannot write {path}: it is read here, and would be lost")


def check_writable(path: Path) -> None:
    """Raise OutputError if a file could not be written at `path`."""
    folder = path.resolve().parent
    if os.path.isdir(path):
        raise OutputError(f"cannot write {path}: it is a directory")
    if not os.path.isdir(folder):
        raise OutputError(f"cannot write {path}: there is no directory {folder}")
    try:
        allowed = os.access(path if path.exists() else folder, os.W_OK)
    except OSError as error:  # a name that no file can have
        raise OutputError(f"cannot write {path}: {error.strerror or error}") from error
    if not allowed:
        raise OutputError(f"cannot write {path}: permission denied")
    check_no_input(path)


def write_bytes(path: Path, content: bytes) -> None:
    """Write beside the final name and move there: a reader never sees half a file."""
    check_no_input(path)
    temporary = ""
    try:
        if path.exists() and not path.is_file():  # /dev/stdout, a pipe
            path.write_bytes(content)
            return
        handle, temporary = tempfile.mkstemp(dir=path.resolve().parent, prefix=f".{path.name}.")
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path.resolve())
    except OSError as error:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise OutputError(f"cannot write {path}: {error.strerror or error}") from error


def write_text(path: Path, content: str) -> None:
    """`write_bytes` of UTF-8 text."""
    write_bytes(path, content.encode())


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
