"""The files that an answer is made of, what they hold, and waiting until that changes.

Which files: those that the package knows to have read, and whatever else was opened beside or below
one of them meanwhile, as modules that a model imports. What they hold: content decides, since an
editor may save twice within what a file system's clock tells apart.
"""
from __future__ import annotations

import contextlib
import hashlib
import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from montecarlo_brdf import files, reading

INTERVAL = 0.25  # seconds from one look at all files to the next
SETTLED = 0.1  # seconds without a change: editors write in pieces and move files about
RECENT = 2.0  # seconds: of a file that is younger the time tells nothing
UNTOLD = 1000  # milliseconds after which one looks although no change was told


class Stamp(NamedTuple):
    """What a file, or the list of a folder's files, was."""

    time: int  # ns
    size: int
    content: bytes


def stamp(path: Path, before: Stamp | None = None) -> Stamp | None:
    """What a file is now, None if there is none. before: spares to read one that is as it was."""
    try:
        known = path.stat()
        same = before and before[:2] == (known.st_mtime_ns, known.st_size)
        if same and time.time() - known.st_mtime > RECENT:
            return before
        content = hashlib.blake2b(_content(path)).digest()
        return Stamp(known.st_mtime_ns, known.st_size, content)
    except OSError:
        return None


def _content(path: Path) -> bytes:
    """Of a folder, which models might import from it; editors' own files are hidden."""
    if not path.is_dir():
        return path.read_bytes()
    names = sorted(n for n in os.listdir(path) if not n.startswith(".") and n != "__pycache__")
    return "\0".join(names).encode(errors="surrogateescape")


class Sources:
    """The files that one answer after another is made of."""

    def __init__(self) -> None:
        self.stamps: dict[Path, Stamp | None] = {}
        self._opened: dict[Path, Stamp | None] = {}

    @contextlib.contextmanager
    def recorded(self) -> Iterator[None]:
        """Note which files are read in a block, and how they were before it; modules made of the
        files known so far are imported anew."""
        reading.forget_modules(self.stamps)
        self._opened = {path: stamp(path, known) for path, known in self.stamps.items()}
        with reading.opened(self._hear):
            try:
                yield
            except BaseException:
                self._keep(broken=True)
                raise
        self._keep(broken=False)

    def changed(self) -> list[Path]:
        """Wait until some files hold something else, and for a moment nothing more; which."""
        for _ in _occasions({path.parent for path in self.stamps}):
            if self._differing() and (found := self._settled()):
                return found
        return []

    def _hear(self, path: Path) -> None:
        if path not in self._opened:
            self._opened[path] = stamp(path)

    def _keep(self, broken: bool) -> None:
        """Watch what was read; after an error also what was read before, and whether files come
        that were missing."""
        read = files.inputs()
        near = {path.parent for path in read}
        found = {p: s for p, s in self._opened.items() if p in read or near & {*p.parents}}
        found |= {path: stamp(path) for path in read if path not in found}
        if broken:
            self.stamps = {**self.stamps, **found, **{p: stamp(p) for p in near}}
        else:
            self.stamps = {p: s for p, s in found.items() if s is not None}

    def _differing(self) -> list[Path]:
        found = []
        for path, known in self.stamps.items():
            now = stamp(path, known)
            if (now and now.content) != (known and known.content):
                found.append(path)
        return found

    def _settled(self) -> list[Path]:
        """What differs once nothing changes any more; nothing if all is as it was."""
        before: list[Stamp | None] | None = None
        while (now := [stamp(path) for path in self.stamps]) != before:
            before = now
            time.sleep(SETTLED)
        return self._differing()


def _occasions(places: set[Path]) -> Iterator[None]:
    """Moments at which files may have changed: at once, then told by `watchfiles` where that is
    installed and can watch these folders, else in short intervals."""
    yield
    with contextlib.suppress(ImportError, OSError, RuntimeError):
        from watchfiles import watch

        there = [path for path in places if path.is_dir()]
        for _ in watch(*there, watch_filter=None, debounce=50, step=10, rust_timeout=UNTOLD,
                       yield_on_timeout=True, raise_interrupt=True, recursive=False):  # fmt: skip
            yield
    while True:
        time.sleep(INTERVAL)
        yield
