"""Compiled kernels on disk: one file each, named by the hash of everything it depends on.

A file is a digest and an object file. It is written beside its final name and moved there, so two
processes that compile the same kernel at once cannot disturb each other; a damaged file does not
match its digest and counts as absent; a cache that cannot be written is not an error, only slow.
Beside them lie notes: files of lines, each with its digest, to which any process may add.
"""
from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
import time
from pathlib import Path

DIGEST = 16
KEEP = 2000  # files; the least recently used beyond that are removed
LARGEST_NOTES = 1 << 20  # bytes; a file of notes beyond that is begun anew
LEFT_BEHIND = 3600.0  # seconds after which nobody writes a file any more


def directory() -> Path:
    """$BRDF_CHECK_CACHE_DIR or the user's cache directory."""
    chosen = os.environ.get("BRDF_CHECK_CACHE_DIR")
    if chosen:
        return Path(chosen)
    import platformdirs

    return Path(platformdirs.user_cache_dir("montecarlo_brdf"))


def read(name: str) -> bytes | None:
    """The stored image, or None if it is absent, unreadable or damaged."""
    path = directory() / f"{name}.o"
    try:
        content = path.read_bytes()
    except OSError:
        return None
    image = content[DIGEST:]
    if content[:DIGEST] != _digest(image):
        return None
    with contextlib.suppress(OSError):
        os.utime(path)
    return image


def write(name: str, image: bytes) -> None:
    """Store an image; silently do without where the directory cannot be written."""
    folder = directory()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=folder, suffix=".part")
    except OSError:
        return
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(_digest(image) + image)
        os.replace(temporary, folder / f"{name}.o")
        _prune(folder)
        clear_leftovers(folder)
    except OSError:
        with contextlib.suppress(OSError):
            os.unlink(temporary)


def notes(name: str) -> list[str]:
    """The lines noted under a name, without damaged ones."""
    path = directory() / f"{name}.txt"
    try:
        content = path.read_bytes()
    except OSError:
        return []
    with contextlib.suppress(OSError):
        os.utime(path)
    whole = (line.partition(b" ") for line in content.splitlines())
    return [text.decode() for digest, _, text in whole if digest == _digest(text).hex().encode()]


def note(name: str, line: str) -> None:
    """Add a line; silently do without where the directory cannot be written."""
    path, text = directory() / f"{name}.txt", line.encode()
    with contextlib.suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "ab") as file:  # one write of a short line: processes do not mix theirs
            if file.tell() > LARGEST_NOTES:
                file.truncate(0)
            file.write(_digest(text).hex().encode() + b" " + text + b"\n")


def _digest(image: bytes) -> bytes:
    return hashlib.blake2b(image, digest_size=DIGEST).digest()


def _prune(folder: Path) -> None:
    files = [*folder.glob("*.o"), *folder.glob("*.txt")]
    if len(files) <= KEEP:
        return
    for path in sorted(files, key=lambda p: p.stat().st_mtime)[: len(files) - KEEP]:
        with contextlib.suppress(OSError):
            path.unlink()


def clear_leftovers(folder: Path) -> None:
    """Remove what processes that were killed while they wrote have left."""
    for path in folder.glob("*.part"):
        with contextlib.suppress(OSError):
            if time.time() - path.stat().st_mtime > LEFT_BEHIND:
                path.unlink()
