"""Which files are read: those that a user's model is made of, modules beside it and tables too.

Python tells of every file that is opened; what is installed and what is ours is left out.
"""
from __future__ import annotations

import contextlib
import functools
import importlib
import linecache
import os
import sys
import sysconfig
import threading
from collections.abc import Callable, Container, Iterable, Iterator
from pathlib import Path
from typing import Any

from montecarlo_brdf.compile import folders

WRITING = os.O_WRONLY | os.O_RDWR
Hear = Callable[[Path], None]
_heard: list[Hear] = []  # who listens; Python keeps a hook for ever
_inside = threading.local()


@contextlib.contextmanager
def opened(hear: Hear) -> Iterator[None]:
    """Have `hear` called with a path before its file is opened to be read, in any thread."""
    _hook(_elsewhere())
    _heard.append(hear)
    try:
        yield
    finally:
        _heard.remove(hear)


def forget_modules(files: Container[Path]) -> None:
    """Have modules that were made of some files, given without links, imported anew."""
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if file and Path(os.path.realpath(file)) in files:
            del sys.modules[name]
    importlib.invalidate_caches()
    linecache.checkcache()


def _elsewhere() -> tuple[str, ...]:
    """Where nobody edits models: Python, what is installed, this package, the cache."""
    installed = map(sysconfig.get_path, ("stdlib", "platstdlib", "purelib", "platlib"))
    places: Iterable[str | Path] = (*installed, Path(__file__).parent, *folders.folders())
    return (*(os.path.realpath(place) + os.sep for place in places), "/proc/", "/dev/", "/sys/")


@functools.cache
def _hook(elsewhere: tuple[str, ...]) -> None:
    """Listen, but to what lies elsewhere."""

    def on_event(event: str, arguments: tuple[Any, ...]) -> None:
        if event != "open" or not _heard or getattr(_inside, "hook", False):
            return
        path, _, flags = arguments
        if not isinstance(path, str) or path.endswith(".pyc") or (flags or 0) & WRITING:
            return
        _inside.hook = True  # what is read here is no news
        try:
            place = os.path.realpath(path)
            if not place.startswith(elsewhere):
                for hear in _heard:
                    hear(Path(place))
        finally:
            _inside.hook = False

    sys.addaudithook(on_event)
