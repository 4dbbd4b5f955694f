"""A progress bar on stderr for work that takes longer than half a second."""
from __future__ import annotations

import contextlib
import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

PATIENCE = 0.5


@contextlib.contextmanager
def progress(title: str) -> Iterator[Callable[[float], None]]:
    """A callback for the fraction done; draws nothing unless stderr is a terminal."""
    started = time.monotonic()
    bar: Any = None
    task: Any = None
    one_at_a_time = threading.Lock()  # checks side by side all tell how far they are

    def update(done: float) -> None:
        nonlocal bar, task
        if time.monotonic() - started < PATIENCE or not (sys.stderr and sys.stderr.isatty()):
            return
        with one_at_a_time:
            if bar is None:
                from rich.console import Console
                from rich.progress import Progress

                bar = Progress(console=Console(stderr=True), transient=True)
                bar.start()
                task = bar.add_task(title, total=1.0)
            bar.update(task, completed=done)

    try:
        yield update
    finally:
        if bar is not None:
            bar.stop()
