"""Where what is compiled is kept: a folder that is written, above others that are only read, and
how large it may become.

$BRDF_CHECK_CACHE_DIR names the folders as $PATH does: what an administrator has compiled for all
lies below what each user adds. $BRDF_CHECK_CACHE_SIZE limits the one that is written.
"""
from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from montecarlo_brdf.errors import UserError

FOLDERS = "BRDF_CHECK_CACHE_DIR"
SIZE = "BRDF_CHECK_CACHE_SIZE"
DEFAULT = 512 << 20  # bytes
UNITS = {"": 1, "K": 1 << 10, "M": 1 << 20, "G": 1 << 30}
SUFFIXES = (".o", ".txt")  # of what is kept; nothing else in a folder is counted or removed
AFTER = 7 / 8  # of the limit is left when files are removed: not at every write
USES = "uses.txt"
MOST_USES = 1 << 20  # a byte each; beyond that one counts anew


def folders() -> list[Path]:
    """Those of $BRDF_CHECK_CACHE_DIR, the highest first, or the user's cache directory."""
    chosen = [Path(name) for name in os.environ.get(FOLDERS, "").split(os.pathsep) if name]
    if chosen:
        return chosen
    import platformdirs

    return [Path(platformdirs.user_cache_dir("montecarlo_brdf"))]


def directory() -> Path:
    """The first that can be written, else the first."""
    return next((folder for folder in folders() if not _fault(folder)), folders()[0])


def fault() -> str | None:
    """Why nothing can be stored, or None if it can. Raises UserError for a size that is none."""
    limit()
    return _fault(directory())


def _fault(folder: Path) -> str | None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        return error.strerror or str(error)
    return None if os.access(folder, os.W_OK | os.X_OK) else "permission denied"


def limit() -> int:
    """The most bytes that the folder that is written may hold."""
    said = os.environ.get(SIZE, "")
    if not said:
        return DEFAULT
    number = re.fullmatch(r"\s*(\d+(?:\.\d+)?)\s*([KMG]?)(?:i?B)?\s*", said, re.IGNORECASE)
    if not number:
        raise UserError(f"{SIZE} must be a number of bytes, as 200M or 2G, not {said!r}")
    return int(float(number[1]) * UNITS[number[2].upper()])


class Stored(NamedTuple):
    """A file of the cache."""

    used: float  # when, the last time
    size: int
    path: str


def stored(folder: Path) -> list[Stored]:
    """What a folder keeps, the least recently used first."""
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        return sorted(_files(entries))
    return []


def _files(entries: Iterator[os.DirEntry[str]]) -> Iterator[Stored]:
    for entry in entries:
        with contextlib.suppress(OSError):  # another process has just removed it
            if entry.name.endswith(SUFFIXES) and entry.is_file():
                known = entry.stat()
                yield Stored(known.st_mtime, known.st_size, entry.path)


_room: dict[tuple[Path, int], int] = {}  # bytes that may be written until one looks again


def keep_within(folder: Path, added: int) -> None:
    """Remove the least recently used files beyond the limit, after some bytes were added.

    To look at all files takes milliseconds: this process may add half of the room that it found,
    so that another one can do the same meanwhile."""
    most = limit()
    room = _room.get((folder, most), 0) - added
    _room[folder, most] = room if room > 0 else (most - _pruned(folder, most)) // 2


def _pruned(folder: Path, most: int) -> int:
    """The bytes that are left."""
    files = stored(folder)
    total = sum(file.size for file in files)
    goal = int(AFTER * most) if total > most else total
    for file in files:
        if total <= goal:
            break
        with contextlib.suppress(OSError):
            os.unlink(file.path)
            total -= file.size
    return total


def count_use(found: bool) -> None:
    """Remember whether something was there when it was asked for."""
    with contextlib.suppress(OSError), open(directory() / USES, "ab") as file:
        if file.tell() >= MOST_USES:
            file.truncate(0)
        file.write(b"+" if found else b"-")  # one byte: processes do not mix theirs


def uses() -> tuple[int, int]:
    """How often something was asked for, as long as is remembered, and how often it was there."""
    with contextlib.suppress(OSError):
        told = (directory() / USES).read_bytes()
        return len(told), told.count(b"+")
    return 0, 0
