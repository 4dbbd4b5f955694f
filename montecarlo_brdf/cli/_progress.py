"""A progress bar on stderr for work that takes longer than half a second."""

from __future__ import annotations

import contextlib
import os
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator

PATIENCE = 0.5
INTERVAL = 0.1  # seconds from one drawing to the next
CELLS = 40
ERASE = "\r\x1b[K"


@contextlib.contextmanager
def progress(title: str) -> Iterator[Callable[[float], None]]:
    """A callback for the fraction done; draws nothing unless stderr is a terminal."""
    started = time.monotonic()
    due = started + PATIENCE
    drawn = False
    one_at_a_time = threading.Lock()  # checks side by side all tell how far they are

    def update(done: float) -> None:
        nonlocal due, drawn
        now = time.monotonic()
        if now < due or not _terminal():
            return
        with one_at_a_time:
            due = now + INTERVAL
            drawn = True
            _write(ERASE + line(title, done, now - started))

    try:
        yield update
    finally:
        if drawn:
            _write(ERASE)


def line(title: str, done: float, seconds: float) -> str:
    """'furnace ########............  42% 13 s left', no wider than the terminal."""
    done = min(max(done, 0.0), 1.0)
    left = f"{(1.0 - done) / done * seconds:.0f} s left" if done else ""
    bar = ("#" * round(CELLS * done)).ljust(CELLS, ".")
    return f"{title} {bar} {done:4.0%} {left}"[: shutil.get_terminal_size().columns - 1]


def _terminal() -> bool:
    return bool(sys.stderr and sys.stderr.isatty()) and os.environ.get("TERM") != "dumb"


def _write(text: str) -> None:
    with contextlib.suppress(OSError):  # a bar is not worth an error
        sys.stderr.write(text)
        sys.stderr.flush()
