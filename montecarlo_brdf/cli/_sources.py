"""The files that an answer is made of, what they hold, and waiting until that changes.

Which files: those that the package knows to have read, and whatever else was opened beside or below
one of them meanwhile, as modules that a model imports. What they hold: content decides, since an
editor may save twice within what a file system's clock tells apart.
"""
from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib
import linecache
import os
import sys
import sysconfig
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from montecarlo_brdf import files
from montecarlo_brdf.compile import folders

INTERVAL = 0.25  # seconds from one look at all files to the next
SETTLED = 0.1  # seconds without a change: editors write in pieces and move files about
RECENT = 2.0  # seconds: of a file that is younger the time tells nothing
UNTOLD = 1000  # milliseconds after which one looks although no change was told
WRITING = os.O_WRONLY | os.O_RDWR


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
        self._elsewhere = tuple(map(str, _libraries()))

    @contextlib.contextmanager
    def recorded(self) -> Iterator[None]:
        """Note which files are read in a block, and how they were before it; modules made of the
        files known so far are imported anew."""
        self._forget_modules()
        self._opened = {path: stamp(path, known) for path, known in self.stamps.items()}
        with _listening(self._hear):
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

    def _hear(self, path: str) -> None:
        place = Path(os.path.realpath(path))
        if place not in self._opened and not str(place).startswith(self._elsewhere):
            self._opened[place] = stamp(place)

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

    def _forget_modules(self) -> None:
        for name, module in list(sys.modules.items()):
            file = getattr(module, "__file__", None)
            if file and Path(os.path.realpath(file)) in self.stamps:
                del sys.modules[name]
        importlib.invalidate_caches()
        linecache.checkcache()


def _libraries() -> Iterable[str | Path]:
    """Where nobody edits models: Python, what is installed, this package, the cache."""
    for name in ("stdlib", "platstdlib", "purelib", "platlib"):
        yield os.path.realpath(sysconfig.get_path(name)) + os.sep
    yield os.path.realpath(Path(__file__).parent.parent) + os.sep
    yield from (os.path.realpath(folder) + os.sep for folder in folders.folders())
    yield from ("/proc/", "/dev/", "/sys/")


_heard: list[Callable[[str], None]] = []  # who listens; Python keeps a hook for ever
_inside = threading.local()


@contextlib.contextmanager
def _listening(hear: Callable[[str], None]) -> Iterator[None]:
    """Have `hear(path)` called before a file is opened to be read."""
    _hook()
    _heard.append(hear)
    try:
        yield
    finally:
        _heard.remove(hear)


@functools.cache
def _hook() -> None:
    sys.addaudithook(_on_event)


def _on_event(event: str, arguments: tuple[Any, ...]) -> None:
    if event != "open" or not _heard or getattr(_inside, "hook", False):
        return
    path, _, flags = arguments
    if not isinstance(path, str) or path.endswith(".pyc") or (flags or 0) & WRITING:
        return
    _inside.hook = True  # what is read here is no news
    try:
        for hear in _heard:
            hear(path)
    finally:
        _inside.hook = False


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
