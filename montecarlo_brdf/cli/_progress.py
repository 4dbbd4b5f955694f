"""A progress bar on stderr for work that takes longer than half a second."""
from __future__ import annotations

import contextlib
import sys
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

    def update(done: float) -> None:
        nonlocal bar, task
        if bar is None:
            if time.monotonic() - started < PATIENCE or not sys.stderr.isatty():
                return
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
