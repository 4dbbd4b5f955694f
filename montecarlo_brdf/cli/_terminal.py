"""What stdout and stderr are, and what they are given: text in columns, and a progress bar for work
that takes longer than half a second."""

from __future__ import annotations

import contextlib
import os
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import TextIO

import click

from montecarlo_brdf.compile import folders
from montecarlo_brdf.compile.kernel import listeners
from montecarlo_brdf.report.text import PLAIN_WIDTH

PATIENCE = 0.5
INTERVAL = 0.1  # seconds from one drawing to the next
CELLS = 40
LONG = 3.0  # seconds of compiling after which one is told
ERASE = "\r\x1b[K"


_kept: list[TextIO] = []


@contextlib.contextmanager
def answers_alone() -> Iterator[None]:
    """stdout is for what a command says: what a model's file prints meanwhile goes to stderr."""
    _kept.append(sys.stdout)
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield
    finally:
        _kept.pop()


def stdout() -> TextIO:
    """Where answers go."""
    return _kept[-1] if _kept else sys.stdout


def width() -> int:
    """Characters of a line: of the terminal, or what a page has room for."""
    known = stdout() is not None and stdout().isatty()
    return shutil.get_terminal_size((PLAIN_WIDTH, 24)).columns if known else PLAIN_WIDTH


def colour() -> bool:
    """Whether stdout gets colours: as https://no-color.org and https://force-color.org say."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") in ("dumb", "unknown"):
        return False
    forced = os.environ.get("FORCE_COLOR")
    return bool(forced) or (stdout() is not None and stdout().isatty())


def tell(text: str) -> None:
    """Print text that may have colours."""
    click.echo(text, file=stdout(), nl=not text.endswith("\n"), color=colour())


@contextlib.contextmanager
def progress(title: str) -> Iterator[Callable[[float], None]]:
    """A callback for the fraction done; draws nothing unless stderr is a terminal."""
    if why := folders.fault():
        slow = "everything is compiled anew each time"
        click.echo(f"Warning: cannot write to {folders.directory()} ({why}): {slow}", err=True)
    if quiet():
        yield lambda done: None
        return
    started = time.monotonic()
    due = started + PATIENCE
    drawn = False
    words = _Words()
    one_at_a_time = threading.Lock()  # checks side by side all tell how far they are

    def update(done: float) -> None:
        nonlocal due, drawn
        now = time.monotonic()
        if now < due or not _terminal():
            return
        with one_at_a_time:
            due = now + INTERVAL
            drawn = True
            _write(ERASE + line(words.compiling or title, done, now - started))

    listeners.append(words.hear)
    try:
        yield update
    finally:
        listeners.remove(words.hear)
        words.end()
        if drawn:
            _write(ERASE)


class _Words:
    """What to say while machine code is made, which the first run of a model waits for."""

    def __init__(self) -> None:
        self.compiling = ""
        self._timer: threading.Timer | None = None

    def hear(self, model: str) -> None:
        """A kernel is compiled; those of the next seconds belong to it."""
        self.compiling = f"compiling {model}"
        if self._timer is None:
            self._timer = threading.Timer(LONG, self._say)
            self._timer.daemon = True
            self._timer.start()

    def _say(self) -> None:
        told = f"{self.compiling}: only the first run after an edit takes so long"
        _write(f"{ERASE}{told}\n" if _terminal() else f"{told}\n")

    def end(self) -> None:
        """Say nothing any more."""
        if self._timer:
            self._timer.cancel()


def quiet() -> bool:
    """Whether nobody wants to hear how it goes: --quiet, or BRDF_CHECK_QUIET."""
    context = click.get_current_context(silent=True)
    asked = bool(context and context.params.get("quiet"))
    return asked or bool(os.environ.get("BRDF_CHECK_QUIET"))


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
